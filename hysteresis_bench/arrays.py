"""The type of every array here: float64 unless a docstring says otherwise; shapes stand in the docstrings."""

from __future__ import annotations

from typing import Any, TypeAlias

from numpy.typing import NDArray

Array: TypeAlias = NDArray[Any]
