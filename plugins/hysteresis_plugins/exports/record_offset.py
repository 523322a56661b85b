"""The constant that a record without an output is given."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports.bias import after as after
from hysteresis_plugins.exports.bias import undone as undone


def part(effect: Any, p: Mapping[str, float], timed: bool) -> Part:
    return Part((effect.default,), invertible=True)
