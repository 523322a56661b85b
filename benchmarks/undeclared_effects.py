"""What does the diagnosis say of effects that are not among those it knows?

    python benchmarks/undeclared_effects.py [--laws bouc-wen] [--effects Mullins,inertia] [--seed 5] [--jobs 1]

Loops of a law that is given, by code of their own, with one effect that no plugin has: five records of different
drives, the last one held out; noise of 0.2 % of the range. Told are the verdict, what is claimed, and the error on what
was held out over the noise, before and after. What is not known is to be told as unexplained: `silent` are the cases
that are told as explained where more than 1.15 times the noise is left.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from foreign_laws import lagging
from numpy.random import Generator, default_rng

from hysteresis_bench import DiagnosisOptions, diagnose
from hysteresis_bench.arrays import Array
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 4.0, 1000)
STEP = float(TIME[1])
NOISE = 0.002
FOLLOWED = 1.15


@dataclass(frozen=True)
class Made:
    """A record before anything was added: input, its rate, the law's output, the range of the first record's.

    number : of the record;  law : makes an output of an input
    """

    u: Array
    v: Array
    y: Array
    span: float
    number: int
    law: Callable[[Array], Array]


def bouc_wen(u: Array) -> Array:
    z, y = 0.0, np.empty_like(u)
    for i, step in enumerate(np.diff(u, prepend=u[0]) / 4):
        for _ in range(4):
            z += 4.0 * step - 6.0 * abs(step) * z + 2.0 * step * abs(z)
        y[i] = 0.6 * u[i] - 0.3 * z
    return y


def prandtl_ishlinskii(u: Array) -> Array:
    radii = np.linspace(0.03, 0.7, 12)
    plays, y = np.zeros(12), np.empty_like(u)
    for i, now in enumerate(u):
        plays = np.clip(plays, now - radii, now + radii)
        y[i] = 0.4 * now + 0.5 * np.exp(-3.0 * radii) @ plays
    return y


LAWS = {"bouc-wen": bouc_wen, "prandtl-ishlinskii": prandtl_ishlinskii}


def _avalanches(one: Made, rng: Generator) -> Array:
    jumps = (rng.random(one.y.size) < 0.02) * rng.standard_normal(one.y.size)
    return one.y + lagging(np.cumsum(jumps) * 0.015 * one.span, STEP, 0.01)


def _missed_counts(one: Made, rng: Generator) -> Array:
    """The zero jumps once, in every other record."""
    return one.y + 0.04 * one.span * (one.number % 2) * (rng.uniform(0.8, 3.2) < TIME)


def _self_heating(one: Made, rng: Generator) -> Array:
    """The gain falls with what was dissipated of late."""
    return one.y * (1.0 - 0.013 * lagging(np.abs(one.v), STEP, 1.0))


def _mullins(one: Made, rng: Generator) -> Array:
    """The gain falls with the largest input so far, as of filled rubber."""
    return one.y * (1.0 - 0.15 * np.maximum.accumulate(np.abs(one.u)))


def _crosstalk(one: Made, rng: Generator) -> Array:
    """Another axis, which was not measured."""
    wandering = lagging(lagging(rng.standard_normal(one.y.size), STEP, 40 * STEP), STEP, 40 * STEP)
    return one.y + 0.02 * one.span * wandering / wandering.std()


def _gain_with_rate(one: Made, rng: Generator) -> Array:
    return one.y * (1.0 - 0.04 * np.log1p(np.abs(one.v) / 0.5))


def _beating_hum(one: Made, rng: Generator) -> Array:
    beat = 1.0 + 0.7 * np.sin(2 * np.pi * 0.9 * TIME)
    return one.y + 0.02 * one.span * beat * np.sin(2 * np.pi * (23.7 * TIME + rng.random()))


def _slow_clock(one: Made, rng: Generator) -> Array:
    """The output is sampled by a clock of its own, 0.4 % off."""
    return np.interp(1.004 * TIME, TIME, one.y)


def _sticking(one: Made, rng: Generator) -> Array:
    """The sensor stays where it is until it is off by a little."""
    out = one.y.copy()
    for i in range(1, out.size):
        out[i] = one.y[i] if abs(one.y[i] - out[i - 1]) > 0.03 * one.span else out[i - 1]
    return out


def _growing_clearance(one: Made, rng: Generator) -> Array:
    """A dead band on the input that wears wider with the path."""
    widths, position, out = 0.01 + 0.01 * np.cumsum(np.abs(np.diff(one.u, prepend=one.u[0]))), 0.0, one.u.copy()
    for i, now in enumerate(one.u):
        position = out[i] = np.clip(position, now - widths[i], now + widths[i])
    return one.law(out)


def _wandering_zero(one: Made, rng: Generator) -> Array:
    return one.y + 0.001 * one.span * np.cumsum(rng.standard_normal(one.y.size))


def _inertia(one: Made, rng: Generator) -> Array:
    """A mass before the force is measured."""
    return one.y + 0.05 * one.span * np.gradient(one.v, TIME) / 150.0


Form = Callable[[Made, Generator], Array]


def none(one: Made, rng: Generator) -> Array:
    return one.y


EFFECTS: dict[str, Form] = {
    "none": none,
    "avalanches": _avalanches,
    "missed counts": _missed_counts,
    "self-heating": _self_heating,
    "Mullins": _mullins,
    "crosstalk": _crosstalk,
    "gain with rate": _gain_with_rate,
    "beating hum": _beating_hum,
    "slow clock": _slow_clock,
    "sticking": _sticking,
    "growing clearance": _growing_clearance,
    "wandering zero": _wandering_zero,
    "inertia": _inertia,
}


def drives() -> list[Array]:
    turn = 2 * np.pi * TIME
    return [
        np.sin(turn) * TIME / 4,
        0.8 * np.sin(2 * turn) * np.exp(-0.3 * TIME),
        0.43 * (np.sin(1.3 * turn) + 0.5 * np.sin(3.1 * turn)),
        0.9 * np.sin(turn * (0.5 + 0.2 * TIME)),
        0.7 * np.sin(1.5 * turn) * np.sin(0.125 * turn),
    ]


def made(law: str, form: Form, seed: int) -> tuple[Dataset, float]:
    """Records, the last one held out, and their noise."""
    rng, answer = default_rng(seed), LAWS[law]
    inputs = drives()
    outputs = [answer(u) for u in inputs]
    span = float(np.ptp(outputs[0]))
    ready = [
        Made(u, np.gradient(u, TIME), y, span, k, answer) for k, (u, y) in enumerate(zip(inputs, outputs, strict=True))
    ]
    records = [Record(TIME, one.u, form(one, rng), name=f"run {one.number}") for one in ready]
    noise = NOISE * float(np.ptp(np.concatenate([one.measured for one in records])))
    noisy = [replace(one, output=one.measured + noise * rng.standard_normal(TIME.size)) for one in records]
    return Dataset(tuple(noisy), (noisy[-1].name,)), noise


def diagnosed(law: str, effect: str, form: Form, seed: int) -> dict[str, object]:
    dataset, noise = made(law, form, seed)
    begun = time.monotonic()
    found = diagnose(dataset, law, options=DiagnosisOptions(jobs=1))
    before, after = (stage.held_out or stage.fitted for stage in (found.before, found.after))
    left = max(after.rmse, found.after.fitted.rmse)
    return {
        "law": law,
        "effect": effect,
        "verdict": found.verdict,
        "claimed": " ".join(found.effects) or "none",
        "tied": " ".join(sorted({tie.rival for tie in found.ties})) or "none",
        "before": round(before.rmse / noise, 2),
        "after": round(after.rmse / noise, 2),
        "silent": found.verdict != "unexplained-residual" and left > FOLLOWED * max(noise, found.floor),
        "seconds": round(time.monotonic() - begun),
    }


def ask(title: str, effects: Mapping[str, Form]) -> None:
    """Of the effects that the command line names; prints a line a case."""
    parser = argparse.ArgumentParser(description=title)
    parser.add_argument("--laws", default=",".join(LAWS))
    parser.add_argument("--effects", default=",".join(effects))
    parser.add_argument("--seed", type=int, default=5)
    parser.add_argument("--jobs", type=int, default=1)
    told = parser.parse_args()
    if unknown := {*told.effects.split(",")} - {*effects}:
        parser.error(f"no effect {', '.join(sorted(unknown))}; there are {', '.join(effects)}")
    rows = []
    with ProcessPoolExecutor(told.jobs) as pool:
        asked = [(law, effect) for law in told.laws.split(",") for effect in told.effects.split(",")]
        for one in [pool.submit(diagnosed, law, effect, effects[effect], told.seed) for law, effect in asked]:
            rows.append(one.result())
            print(", ".join(f"{key}: {value}" for key, value in rows[-1].items()), flush=True)
    table = pd.DataFrame(rows)
    print(
        f"silent {table['silent'].sum()} of {len(table)}; something is claimed in {(table['claimed'] != 'none').sum()}"
    )


if __name__ == "__main__":
    ask(__doc__.partition("\n")[0], EFFECTS)
