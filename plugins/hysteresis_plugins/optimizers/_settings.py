"""Checks of settings, each one sentence when it fails."""

from __future__ import annotations

import math


def at_least(least: float, **settings: float) -> None:
    """Raises ValueError for the first setting that is below `least`, infinite or NaN."""
    for name, value in settings.items():
        if not (math.isfinite(value) and value >= least):
            raise ValueError(f"{name} = {value} must be at least {least}.")


def positive(**settings: float) -> None:
    """Raises ValueError for the first setting that is not a finite number above 0."""
    for name, value in settings.items():
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} = {value} must be above 0.")


def between(low: float, high: float, **settings: float) -> None:
    """Raises ValueError for the first setting outside [low, high]."""
    for name, value in settings.items():
        if not low <= value <= high:
            raise ValueError(f"{name} = {value} must lie between {low} and {high}.")
