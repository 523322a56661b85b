"""Whether a fitted model and a rig belong together: units, and the range of the input."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from hysteresis_bench.contracts import SteppedRig
from hysteresis_bench.control.compensation import Forward
from hysteresis_bench.data.units import same_unit
from hysteresis_bench.fit.model_file import FittedModel

WORTH_WHILE = 0.25
"""Share of the amplitude that a rig must be able to reach by the model."""
TIMED = re.compile(r"\{time\}|\bs\b")
"""In a parameter's unit: the data's unit of time, or seconds whatever the data are in."""


def check_units(fitted: FittedModel, forward: Forward, rig: SteppedRig, name: str) -> None:
    """Raises ValueError where the rig's units are not the model's; a model without units is taken to have the rig's.
    The time counts where the model knows one."""
    compared = ("time", "input", "output") if forward.linear or _knows_time(fitted) else ("input", "output")
    faults = [
        f"{column} is in {fitted.units[column]} in the model and in {rig.units[column]} on the rig {name}."
        for column in compared
        if column in rig.units
        and fitted.units[column] != "1"
        and not same_unit(fitted.units[column], rig.units[column])
    ]
    if faults:
        raise ValueError(" ".join([*faults, "Fit the model to data in the rig's units."]))


def _knows_time(fitted: FittedModel) -> bool:
    """Whether a parameter of the model or of an effect, found or fixed, has a unit with a time in it."""
    parameters = replace(fitted.system, fixed={}).parameters
    return any(TIMED.search(parameter.unit) for parameter in parameters)


def range_words(fitted: FittedModel, forward: Forward, limit: float, amplitude: float) -> list[str]:
    """What is odd about the range of the input, a sentence each; limit : of the rig, to either side.

    Raises ValueError where the rig reaches less than WORTH_WHILE of the amplitude.
    """
    unit = "" if fitted.units["input"] == "1" else f" {fitted.units['input']}"
    needed = _needed(forward, amplitude)
    found = []
    if _needed(forward, WORTH_WHILE * amplitude) > limit:
        raise ValueError(
            f"an amplitude of {amplitude:g} needs {needed:.3g}{unit} by the model, and the rig takes {limit:g}{unit} "
            f"to either side: less than {WORTH_WHILE:.0%} of it can be reached. Choose a smaller amplitude, or a rig "
            "that the model was fitted to."
        )
    if needed > limit:
        found.append(
            f"An amplitude of {amplitude:g} needs {needed:.3g}{unit} by the model; the rig takes {limit:g}{unit}."
        )
    ranges = fitted.data.get("ranges") or {}
    widest = max((abs(edge) for edge in ranges.get("input", ())), default=None)
    if widest is not None and widest > limit:
        found.append(
            f"The model was fitted to inputs up to {widest:.3g}{unit}, and the rig takes {limit:g}{unit}: "
            "how well the model knows loops that small, its fit does not tell."
        )
    elif widest is not None and min(needed, limit) > 1.1 * widest:
        found.append(
            f"The model was fitted to inputs up to {widest:.3g}{unit}; {min(needed, limit):.3g}{unit} lies beyond."
        )
    return found


def _needed(forward: Forward, amplitude: float) -> float:
    """The largest input, by the static inverse, of one slow period."""
    period = amplitude * np.sin(np.linspace(0.0, 2.0 * np.pi, 401))
    return float(np.max(np.abs(forward.input_for(period + forward.offset)[0])))
