"""What several tests share: a small model, misbehaving plugins, the folder of real measurements."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy: threads only wait for each other on small matrices

os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # each of the processes that tests start would compile all modules anew

import numpy as np
import pytest
from hypothesis import settings

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.hypotheses import systems
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record, read_only

ROOT = Path(__file__).parents[1]
PLUGINS = ROOT / "tests" / "test_plugins"
settings.register_profile("compiled", deadline=None)  # a first example loads or compiles the kernel that it calls
settings.load_profile("compiled")
sys.path.append(str(PLUGINS))  # importlib.metadata finds its entry points there, as of any distribution


@pytest.fixture(scope="session")
def real_data() -> Path:
    """The folder of real measurements; tests that need it are skipped without."""
    folder = Path(os.environ.get("HYSTERESIS_DATA", ROOT.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip("no real measurements: set HYSTERESIS_DATA to their folder")
    return folder


def forget_plugins() -> None:
    """What is registered is asked anew: a test that adds a distribution does so before it and after it."""
    for cache in (registry._points, registry.offered, registry.effect, systems._built):
        cache.cache_clear()


def record(samples: int = 40, name: str = "sine", a: float = 1.0, b: float = 0.5) -> Record:
    time = np.linspace(0.0, 1.0, samples)
    drive = np.sin(2 * np.pi * time)
    return Record(time, drive, a * drive + b * drive**3, name=name)


def as_models_call(kernel: Callable[..., Array], *given: int) -> Callable[..., Array]:
    """The kernel with these of its arguments read-only and side by side in memory, as those of a signal are: for any
    other kind of array it is compiled once more, which takes up to ten seconds."""

    def called(*arguments: object) -> Array:
        return kernel(*(read_only(one) if place in given else one for place, one in enumerate(arguments)))

    return called


@pytest.fixture
def polynomial_problem() -> Problem:
    system = System(registry.build("models", "polynomial"))
    return Problem(system, (record(),), Space(system.parameters), LOSSES["rmse"])
