"""How well a feed-forward is expected to do: sines of several amplitudes and frequencies, by the fitted model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from hysteresis_bench.arrays import Array
from hysteresis_bench.control.references import faded_in
from hysteresis_bench.control.trajectories.driven import drive, forward_of
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.fit.unseen.excited import AMPLITUDE, FREQUENCY, unlike
from hysteresis_bench.progress import OnStep, Step, quiet

AMPLITUDES = (0.1, 0.25, 0.5, 0.9)
"""Amplitudes in half ranges of the fitted outputs, about their middle."""
CENTRED = 0.05
"""Share of the half range of the fitted outputs up to which their middle is taken as 0, where a device is at rest."""
SLOWEST, FASTEST = 1e-9, 1e9
"""Frequencies that are swept: an actuator turns neither slower nor faster, in whichever unit of time."""
SMALLEST, LARGEST = 1e-30, 1e30
"""Amplitudes whose squares and shares are still numbers, in whichever unit."""
PERIODS, SCORED, SAMPLES = 4, 2, 250
"""Of a sine, of these at the end scored, and samples a period."""


def sweep(
    fitted: FittedModel, frequencies: Sequence[float], amplitudes: Sequence[float] = (), on_step: OnStep = quiet
) -> pd.DataFrame:
    """A row an amplitude and frequency: amplitude, frequency, input (the largest), left, expected, beyond, reason.

    frequencies : 1 / unit of time;  amplitudes : unit of the output, by default AMPLITUDES
    left : RMS of the model's answer less the sine;  expected : of that and of the model's own error together
    beyond : in what the input differs from the fitted ones, as words such as "faster, larger", or ""
    reason : why no input was found, "" where one was
    Raises UserError telling frequencies and amplitudes that cannot be, ValueError where no input was found for any, or
    no amplitude is told and the model keeps no range.
    """
    if faults := [*_impossible(frequencies, amplitudes)]:
        raise UserError("sweep", faults)
    forward, rmse = forward_of(fitted), _own_error(fitted)
    ranges = fitted.data.get("ranges") or {}
    if not ranges and not amplitudes:
        raise ValueError("the model file does not keep the range of the fitted records; give an amplitude.")
    low, high = ranges.get("output", (0.0, 0.0))
    least, most = ranges.get("input", (-np.inf, np.inf))
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    middle, wanted = (
        middle if abs(middle) > CENTRED * half else 0.0,
        tuple(amplitudes) or tuple(half * s for s in AMPLITUDES),
    )
    rows: list[dict[str, Any]] = []
    for amplitude, frequency in product(wanted, frequencies):
        on_step(Step("sines", len(rows), len(wanted) * len(frequencies)))
        row: dict[str, Any] = {"amplitude": amplitude, "frequency": frequency}
        time, sine = _sine(frequency, amplitude)
        try:
            driven = drive(fitted, forward, time, middle + sine)
        except ValueError as error:
            rows.append(row | {"reason": str(error)})
            continue
        off = (driven.reached - middle - sine)[-SCORED * SAMPLES :]
        left = float(np.sqrt(np.mean(off**2)))
        scored = driven.input[-SCORED * SAMPLES :]
        own = {FREQUENCY: (frequency, frequency), AMPLITUDE: (0.5 * float(np.ptp(scored)),) * 2}
        words = ["larger"] * bool(np.min(driven.input) < least or np.max(driven.input) > most)
        found = {
            "input": float(np.max(np.abs(driven.input))),
            "left": left,
            "expected": float(np.hypot(left, rmse)),
            "beyond": ", ".join(dict.fromkeys([*unlike(fitted.data.get("excited") or {}, own), *words])),
        }
        rows.append(row | found | {"reason": ""})
    if reasons := _everywhere(rows):
        raise ValueError(reasons)
    columns = ["amplitude", "frequency", "input", "left", "expected", "beyond", "reason"]
    return pd.DataFrame(rows).reindex(columns=columns)


def _impossible(frequencies: Sequence[float], amplitudes: Sequence[float]) -> Iterator[str]:
    """A sentence on every value that is no number, or beyond what an actuator does."""
    per = "cycles a unit of the model's time"
    for one in frequencies:
        if not SLOWEST <= one <= FASTEST:
            yield f"a frequency of {one:g} cannot be; choose one from {SLOWEST:g} to {FASTEST:g} {per}."
    for one in amplitudes:
        if not SMALLEST <= one <= LARGEST:
            yield f"an amplitude of {one:g} cannot be; choose one from {SMALLEST:g} to {LARGEST:g}."


def _everywhere(rows: Sequence[dict[str, Any]]) -> str:
    """Why no input was found, "" where one was."""
    if any(not row["reason"] for row in rows):
        return ""
    reasons = list(dict.fromkeys(row["reason"] for row in rows))
    if len(reasons) == 1:
        return str(reasons[0])
    first = rows[0]
    return (
        f"for none of {len(rows)} sines; for the first, of amplitude {first['amplitude']:.4g} and frequency "
        f"{first['frequency']:.4g}: {first['reason']}"
    )


def _own_error(fitted: FittedModel) -> float:
    """RMSE on what was held out, or on what was fitted."""
    errors = fitted.error.get("held_out") or fitted.error.get("fitted") or {}
    return float(errors.get("rmse", np.nan))


def _sine(frequency: float, amplitude: float) -> tuple[Array, Array]:
    """Time and a sine that fades in over its first two periods, both (samples,)."""
    time = np.arange(PERIODS * SAMPLES) / (SAMPLES * frequency)
    return time, amplitude * faded_in(time * frequency / (PERIODS - SCORED)) * np.sin(2.0 * np.pi * frequency * time)
