"""What cannot go on by one sample of time and input, each with its reason."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NoReturn


def temperature(effect: Any, p: Mapping[str, float], timed: bool) -> NoReturn:
    raise ValueError("it needs the temperature, and a step is given time and input alone")


def rate(effect: Any, p: Mapping[str, float], timed: bool) -> NoReturn:
    raise ValueError("the rate at a sample is the central difference, which needs the next sample")


def ahead(effect: Any, p: Mapping[str, float], timed: bool) -> NoReturn:
    raise ValueError("it needs the input to come, as that is recorded later than it acts")


def another_clock(effect: Any, p: Mapping[str, float], timed: bool) -> NoReturn:
    raise ValueError("by its clock the output is ahead of the input, or behind it by more and more")


def description(effect: Any, p: Mapping[str, float], timed: bool) -> None:
    if effect.terms:
        raise ValueError("its terms are made of a whole record, samples to come included")
