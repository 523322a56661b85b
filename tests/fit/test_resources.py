import ctypes
import gc
import resource
import subprocess
import sys

import numpy as np
import pytest
from threadpoolctl import threadpool_info

from hysteresis_bench import FitOptions, fit
from hysteresis_bench.kernels.resources import NEW_OBJECTS, economical
from hysteresis_bench.signals import Dataset, Record

GLIBC = sys.platform == "linux" and hasattr(ctypes.CDLL(None), "mallopt")


def threads() -> dict[str, int]:
    import scipy.linalg  # noqa: F401 - scipy's BLAS is another one than numpy's

    return {one["filepath"]: one["num_threads"] for one in threadpool_info() if one["user_api"] == "blas"}


def test_every_blas_has_one_thread_and_then_as_many_as_before():
    before = threads()
    with economical():
        inside = threads()
        with economical():
            assert set(threads().values()) == {1}
        assert set(threads().values()) == {1}  # the inner one restores nothing
    assert inside == dict.fromkeys(before, 1)
    assert threads() == before


def test_settings_come_back_after_a_fault():
    before = threads(), gc.get_threshold()
    with pytest.raises(ZeroDivisionError), economical():
        _ = 1 / 0
    assert (threads(), gc.get_threshold()) == before


@pytest.mark.parametrize(("own", "inside"), [(700, NEW_OBJECTS), (2 * NEW_OBJECTS, 2 * NEW_OBJECTS), (0, 0)])
def test_garbage_is_collected_less_often_and_never_more(own, inside):
    before = gc.get_threshold()
    gc.set_threshold(own, 10, 10)
    try:
        with economical():
            assert gc.get_threshold() == (inside, 10, 10)
        assert gc.get_threshold() == (own, 10, 10)
    finally:
        gc.set_threshold(*before)


def test_scipys_own_blas_is_limited_though_nobody_has_imported_it():
    code = """
from hysteresis_bench.kernels.resources import NEW_OBJECTS, economical
from threadpoolctl import threadpool_info
with economical():
    import scipy.linalg
    print({one["num_threads"] for one in threadpool_info() if one["user_api"] == "blas"})
"""
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "{1}\n"


@pytest.mark.skipif(not GLIBC, reason="another C library keeps memory as it likes")
def test_a_fit_keeps_its_memory():
    time = np.linspace(0.0, 6.0, 6000)
    drive = 2.5 * np.sin(np.pi * time)
    data = Dataset((Record(time, drive, drive - 0.3 * np.cos(np.pi * time)),))
    options = FitOptions(budget=1000)
    fit(data, "bouc-wen", ["creep"], options=options)  # compiles
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    fit(data, "bouc-wen", ["creep"], options=options)
    assert (
        resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before < 20000
    )  # 66 alone in a process; 686 000 before; a process that ran other tests pages in more
