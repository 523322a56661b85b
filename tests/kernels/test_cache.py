"""Kernels in numba's disk cache: processes that fill it one after the other, and names that cannot clash."""

import gc
import importlib
import os
import pkgutil
import subprocess
import sys
from collections import Counter

import pytest
from numba.core.registry import CPUDispatcher

import hysteresis_bench.kernels
import hysteresis_plugins.rigs

CALLED = """
import sys
import numpy as np
from hysteresis_bench.kernels.jiles_atherton import jiles_atherton
for kind in sys.argv[1:]:
    H = np.sin(np.arange(40.0))[:, None] * (np.ones(1) if "shared" in kind else np.ones(2))
    p = [np.full(2, x) for x in (1e-6, 6.0, 10.0, 2.5e6, 0.2)]
    print(jiles_atherton(H, *p, "clamped" in kind)[-1, 1].hex())
"""


def called(cache, *kinds):
    """The last values of the kernels called in this order by a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", CALLED, *kinds],
        env=os.environ | {"NUMBA_CACHE_DIR": str(cache)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@pytest.mark.long
def test_processes_that_fill_a_fresh_cache_in_turn_agree(tmp_path):
    """Every process finds the kernels of those before it in the cache and adds one; the last finds all."""
    kinds, known = ("shared clamped", "shared", "own", "own clamped"), []
    for count in range(1, len(kinds) + 1):
        found = called(tmp_path, *kinds[:count])
        assert found[:-1] == known
        known = found
    assert known[1] != known[0]  # a kernel in the place of another would be seen
    assert known[2] != known[3]
    assert called(tmp_path, *kinds) == known


def kernels_in_the_cache():
    for package in (hysteresis_bench.kernels, hysteresis_plugins.rigs):
        for module in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
            importlib.import_module(module.name)
    every = (kernel for kernel in gc.get_objects() if type(kernel) is CPUDispatcher)
    return [
        kernel for kernel in every if kernel.py_func.__module__.startswith("hysteresis_") and kernel._cache.cache_path
    ]


def test_every_cached_kernel_has_a_name_and_a_place_of_its_own():
    kernels = kernels_in_the_cache()
    assert len(kernels) > 30
    functions = [kernel.py_func for kernel in kernels]
    names = [f"{function.__module__}.{function.__qualname__}" for function in functions]
    assert [name for name in names if "<locals>" in name] == []  # closures share one name and one place
    assert [name for name, times in Counter(names).items() if times > 1] == []
    places = Counter((function.__code__.co_filename, function.__code__.co_firstlineno) for function in functions)
    assert [place for place, times in places.items() if times > 1] == []
