"""What a plugin could change in its process, and so in the trials that follow: it must not."""

from __future__ import annotations

import os
import random
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from hysteresis_bench.testing.contract import expect


@contextmanager
def undisturbed(seed: int) -> Iterator[None]:
    """Raises Broken where what runs inside leaves the process other than it was. seed : of the global generators"""
    kept = random.getstate(), np.random.get_state()  # noqa: NPY002
    random.seed(seed)
    np.random.seed(seed)  # noqa: NPY002
    try:
        with np.errstate(all="warn"):
            before = _state()
            yield
            after = _state()
    finally:
        random.setstate(kept[0])
        np.random.set_state(kept[1])  # noqa: NPY002
    changed = [what for what in before if before[what] != after[what]]
    expect(not changed, f"it changes {', '.join(changed)} for whatever runs next in its process.")


def _state() -> dict[str, object]:
    numbers: dict[str, Any] = np.random.get_state(legacy=False)  # noqa: NPY002
    return {
        "Python's global random numbers": random.getstate(),
        "numpy's global random numbers": (numbers["state"]["key"].tobytes(), numbers["state"]["pos"]),
        "numpy's handling of floating-point errors": (np.geterr(), np.geterrcall()),
        "numpy's print options": repr(np.get_printoptions()),
        "the filters of warnings": list(warnings.filters),
        "the environment": dict(os.environ),
        "the working directory": os.getcwd(),
        "the number of threads": threading.active_count(),
    }
