"""What does the diagnosis say of records that no registered law makes?

    python benchmarks/foreign_laws.py [--first 1] [--count 72] [--jobs 1] [--timeout 600]

Eight laws of the field that are not registered, each with none or one effect by a formula of its own, nothing given:
five records of different drives, lengths and amplitudes, one of them held out; noise of 0.1 or 0.3 % of the range. A
case is right where the effect is named, tied with what is named, or its family is named with a curve, and nothing else
is claimed. Told besides are what stands in for the law, and what is left of the record that was held out, over the
noise, before and after: laws that cannot be followed are to be told as unexplained.

Laws, with their sources: `unregistered_laws.py`.
"""

from __future__ import annotations

import argparse
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from typing import NamedTuple

import numpy as np
import pandas as pd
from limited import limited
from numpy.random import Generator, default_rng
from scipy.signal import lfilter
from unregistered_laws import LAWS

from hysteresis_bench import DiagnosisOptions, diagnose
from hysteresis_bench.arrays import Array
from hysteresis_bench.diagnosis.families import forms_of
from hysteresis_bench.diagnosis_study.case import by_family, compared
from hysteresis_bench.signals import Dataset, Record

FINER = 8
"""Steps of a law for each sample."""

EFFECTS = (
    "",
    "output-lag",
    "transport-delay",
    "drift",
    "creep",
    "saturation",
    "periodic-disturbance",
    "fatigue",
    "temperature-sensitivity",
)
DRIVES = ("growing", "triangle", "multi", "falling", "chirp", "biased")
AMPLITUDES = (1.0, 0.8, 0.6, 0.9, 0.7)


def lagging(x: Array, step: float, tau: float) -> Array:
    a = np.exp(-step / tau)
    return np.asarray(lfilter([1 - a], [1, -a], x, zi=[a * x[0]])[0])


def with_effect(name: str, y: Array, u: Array, t: Array, temperature: Array, rng: Generator) -> Array:
    """y with the effect; span of y: about 2."""
    if name == "output-lag":
        return lagging(y, t[1], rng.uniform(0.02, 0.06))
    if name == "transport-delay":
        late = int(rng.uniform(0.01, 0.04) / t[1])
        return np.concatenate([np.full(late, y[0]), y[:-late]])
    if name == "drift":
        return y + rng.uniform(0.03, 0.1) * 2.0 * t / 4
    if name == "creep":
        weight = rng.uniform(0.03, 0.06)
        return y + sum(weight * lagging(y, t[1], tau) for tau in (0.05, 0.15, 0.5))
    if name == "saturation":
        most = rng.uniform(0.6, 0.9) * np.abs(y).max()
        return np.asarray(most * np.tanh(y / most))
    if name == "periodic-disturbance":
        return y + rng.uniform(0.01, 0.03) * 2.0 * np.sin(2 * np.pi * rng.uniform(8, 20) * t)
    if name == "fatigue":
        path = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(u)))])
        return y * (1 - rng.uniform(0.1, 0.25) * (1 - 1 / (1 + path / 10)))
    if name == "temperature-sensitivity":
        return y * (1 + rng.uniform(0.005, 0.01) * (temperature - 20))
    return y


def drive(kind: str, top: float, length: float, t: Array, rng: Generator) -> Array:
    phase = 2 * np.pi * rng.integers(1, 6) / length * t
    if kind == "growing":
        return np.asarray(top * (0.3 + 0.7 * t / length) * np.sin(phase))
    if kind == "triangle":
        return np.asarray(top * 2 / np.pi * np.arcsin(np.sin(phase)))
    if kind == "multi":
        waves = sum(np.sin(2 * np.pi * rng.uniform(0.5, 3) * k / length * t) for k in range(1, 5))
        return np.asarray(top * waves / np.abs(waves).max())
    if kind == "falling":
        return np.asarray(top * (1 - 0.8 * t / length) * np.sin(phase))
    if kind == "biased":
        return np.asarray(top * (0.5 * np.sin(phase) + 0.4 * (1 - np.cos(np.pi * t / length))))
    return np.asarray(top * np.sin(2 * np.pi * (0.5 * t + rng.uniform(0.3, 0.8) * t * t / length * 2)))


class Case(NamedTuple):
    law: str
    effect: str
    noise: float
    dataset: Dataset


def made(seed: int) -> Case:
    """Every pair of a law and an effect, or none, once in 72 seeds."""
    rng = default_rng([seed, 777])
    law, effect = [*LAWS][seed % len(LAWS)], EFFECTS[(2 * (seed // len(LAWS)) + seed % len(LAWS)) % len(EFFECTS)]
    of_law, of_effect = int(rng.integers(1 << 30)), int(rng.integers(1 << 30))
    measured = []
    for kind, top in zip([*rng.permutation(DRIVES)][: len(AMPLITUDES)], AMPLITUDES, strict=True):
        length, samples = rng.uniform(1.5, 4.0), int(rng.integers(500, 900))
        t = np.linspace(0, length, samples * FINER)
        u = drive(kind, top, length, t, rng)
        temperature = 20 + rng.uniform(-8, 12) + 3 * t / length
        y = with_effect(effect, LAWS[law](u, default_rng(of_law)), u, t, temperature, default_rng(of_effect))
        measured.append((str(kind), t[::FINER], u[::FINER], y[::FINER], temperature[::FINER]))
    noise = float(rng.choice([0.001, 0.003]) * np.ptp(np.concatenate([y for _, _, _, y, _ in measured])))
    records = tuple(
        Record(
            t,
            u,
            y + noise * rng.standard_normal(t.size),
            name,
            columns={"temperature": temperature} if effect == "temperature-sensitivity" else {},
        )
        for name, t, u, y, temperature in measured
    )
    return Case(law, effect, noise, Dataset(records, (records[3].name,)))


def diagnosed(seed: int, timeout: int) -> dict[str, object]:
    case, begun = made(seed), time.monotonic()
    made_by = {"made by": case.law, "effect": case.effect or "none"}
    row: dict[str, object] = {"seed": seed, **made_by, "right": False, "false": False}
    try:
        with limited(timeout):
            found = diagnose(case.dataset, options=DiagnosisOptions(jobs=1))
    except TimeoutError:
        return {**row, "verdict": "too late"}
    rivals = {name: {tie.rival for tie in found.ties if tie.effect == name} for name in found.effects}
    truth = [case.effect] if case.effect else []
    _, _, missed, extra = compared(truth, found.effects, rivals)
    family = by_family(missed, [{*forms_of((name, *rivals[name])).values()} for name in extra])
    before, after = (stage.held_out or stage.fitted for stage in (found.before, found.after))
    return {
        **row,
        "right": len(missed) == len(family) and len(extra) == len(family),
        "false": len(extra) > len(family),
        "found": found.model_name,
        "claimed": " ".join(found.effects) or "none",
        "tied": " ".join(sorted({tie.rival for tie in found.ties})) or "none",
        "stand-ins": " ".join(found.stand_ins) or "none",
        "verdict": found.verdict,
        "before": round(before.rmse / case.noise, 2),
        "after": round(after.rmse / case.noise, 2),
        "seconds": round(time.monotonic() - begun),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=72)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--timeout", type=int, default=600)
    told = parser.parse_args()
    rows = []
    with ProcessPoolExecutor(told.jobs) as pool:
        seeds = range(told.first, told.first + told.count)
        for one in as_completed([pool.submit(diagnosed, seed, told.timeout) for seed in seeds]):
            rows.append(one.result())
            print(", ".join(f"{key}: {value}" for key, value in rows[-1].items()), flush=True)
    table = pd.DataFrame(rows)
    counts = table.groupby("made by")["right"].agg(right="sum", cases="count")
    print(counts.to_string())
    print(f"right {table['right'].sum()} of {len(table)}, something false is claimed in {table['false'].sum()}")


if __name__ == "__main__":
    main()
