"""Is the diagnosis right where a controller closes a loop around the device, so that its noise comes back in the input?

    python benchmarks/closed_loop.py [--laws bouc-wen] [--effects creep,drift] [--bandwidth 10] [--noise 0.003]
        [--strides 1,2,1,3,2] [--strength 1] [--seed 3] [--jobs 1]

An integral controller makes the measured output of a law, with an effect beside it, follow five references, the last
one held out; law, effect and controller are computed sample by sample, by code of their own. The input is what the
controller commands, known exactly, and as rough as the noise that it answers to. Every record may be logged at a rate
of its own: `strides` are the samples from one that is kept to the next. Told are the verdict, what is claimed, and the
error on what was held out over the noise, before and after.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from typing import TypeAlias

import numpy as np
from numpy.random import default_rng
from undeclared_effects import STEP, TIME, drives

from hysteresis_bench import DiagnosisOptions, diagnose
from hysteresis_bench.arrays import Array
from hysteresis_bench.signals import Dataset, Record

Device: TypeAlias = Callable[[float], float]
"""Of one sample of the input, the next one of the output."""

GAIN = 0.8
"""About how much the output moves with the input: it makes the controller's gain of its bandwidth."""

REACH = 0.36
"""Of the range of the open loop, how far the references go."""


def _bouc_wen() -> Device:
    z = before = 0.0

    def step(u: float) -> float:
        nonlocal z, before
        du = (u - before) / 60.0
        for _ in range(60):
            z += 4.0 * du - 6.0 * abs(du) * z + 2.0 * du * abs(z)
        before = u
        return 0.6 * u - 0.3 * z

    return step


def _prandtl_ishlinskii() -> Device:
    radii, plays = np.linspace(0.03, 0.7, 12), np.zeros(12)

    def step(u: float) -> float:
        plays[:] = np.clip(plays, u - radii, u + radii)
        return 0.4 * u + float(0.5 * np.exp(-3.0 * radii) @ plays)

    return step


def _lag(constant: float) -> Device:
    """Exact for what is linear between its samples."""
    kept = np.exp(-STEP / constant)
    passed = (1.0 - kept) * constant / STEP
    follows = before = 0.0

    def step(x: float) -> float:
        nonlocal follows, before
        follows = kept * follows + (1.0 - kept) * before + (1.0 - passed) * (x - before)
        before = x
        return float(follows)

    return step


def _input_lag(law: Device, strength: float) -> Device:
    lag = _lag(0.03 * strength)
    return lambda u: law(lag(u))


def _output_lag(law: Device, strength: float) -> Device:
    lag = _lag(0.03 * strength)
    return lambda u: lag(law(u))


def _creep(law: Device, strength: float) -> Device:
    lags = [_lag(constant) for constant in (0.1, 0.4, 1.6)]

    def step(u: float) -> float:
        y = law(u)
        return y + 0.06 * strength * sum(lag(y) for lag in lags)

    return step


def _saturation(law: Device, strength: float) -> Device:
    level = 0.35 / strength
    return lambda u: level * float(np.tanh(law(u) / level))


def _with_time(law: Device, of: Callable[[float], float]) -> Device:
    clock = iter(TIME)
    return lambda u: law(u) + of(next(clock))


def _drift(law: Device, strength: float) -> Device:
    return _with_time(law, lambda t: 0.02 * strength * t)


def _hum(law: Device, strength: float) -> Device:
    return _with_time(law, lambda t: 0.01 * strength * float(np.sin(2.0 * np.pi * 13.3 * t)))


LAWS: dict[str, Callable[[], Device]] = {"bouc-wen": _bouc_wen, "prandtl-ishlinskii": _prandtl_ishlinskii}
EFFECTS: dict[str, Callable[[Device, float], Device]] = {
    "none": lambda law, strength: law,
    "input-lag": _input_lag,
    "output-lag": _output_lag,
    "creep": _creep,
    "saturation": _saturation,
    "drift": _drift,
    "hum": _hum,
}


def controlled(device: Device, reference: Array, noise: Array, bandwidth: float) -> tuple[Array, Array]:
    """Input and measured output, (samples,) each; bandwidth : Hz"""
    u, y = np.zeros(TIME.size), np.zeros(TIME.size)
    y[0] = device(0.0) + noise[0]
    for k in range(1, TIME.size):
        u[k] = u[k - 1] + 2.0 * np.pi * bandwidth / GAIN * STEP * (reference[k - 1] - y[k - 1])
        y[k] = device(u[k]) + noise[k]
    return u, y


def diagnosed(law: str, effect: str, told: argparse.Namespace) -> str:
    rng, strides = default_rng(told.seed), [int(stride) for stride in told.strides.split(",")]
    open_loop = LAWS[law]()
    span = float(np.ptp([open_loop(u) for u in drives()[0]]))
    records = []
    for number, drive in enumerate(drives()):
        noise = told.noise * span * rng.standard_normal(TIME.size)
        u, y = controlled(EFFECTS[effect](LAWS[law](), told.strength), REACH * span * drive, noise, told.bandwidth)
        kept = slice(None, None, strides[number % len(strides)])
        records.append(Record(TIME[kept], u[kept], y[kept], name=f"run {number}"))
    begun = time.monotonic()
    found = diagnose(Dataset(tuple(records), (records[-1].name,)), law, options=DiagnosisOptions(jobs=1))
    before, after = (
        (stage.held_out or stage.fitted).rmse / (told.noise * span) for stage in (found.before, found.after)
    )
    return (
        f"law: {law}, effect: {effect}, verdict: {found.verdict}, claimed: {' '.join(found.effects) or 'none'}, "
        f"before: {before:.2f}, after: {after:.2f}, floor: {found.floor / (told.noise * span):.2f}, "
        f"seconds: {time.monotonic() - begun:.0f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--laws", default=",".join(LAWS))
    parser.add_argument("--effects", default=",".join(EFFECTS))
    parser.add_argument("--bandwidth", type=float, default=10.0)
    parser.add_argument("--noise", type=float, default=0.003)
    parser.add_argument("--strides", default="1")
    parser.add_argument("--strength", type=float, default=1.0, help="of the effect")
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=1)
    told = parser.parse_args()
    with ProcessPoolExecutor(told.jobs) as pool:
        asked = [(law, effect) for law in told.laws.split(",") for effect in told.effects.split(",")]
        for one in [pool.submit(diagnosed, law, effect, told) for law, effect in asked]:
            print(one.result(), flush=True)


if __name__ == "__main__":
    main()
