"""Is the law found beside an effect that is not known? `diagnose` without a model, on made data.

    python benchmarks/law_beside_effects.py [LAW ...] [--effects NONE,output-lag,...] [--seed 0]

Every law makes five records at different rates and amplitudes, one of them held out, alone and with one effect of a
random size; the noise is 0.3 % of the range. Told are the law that is found, what is named, what is left of the record
that was held out over its noise, and the time that it took.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd

from hysteresis_bench import diagnose, registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.signals import Dataset, Record

NOISE, SPREAD, SAMPLES = 0.003, 0.15, 600
"""Noise as a share of the range; spread of the logarithms of a law's parameters; samples a record."""
AMPLITUDES, HELD_OUT = (1.0, 0.8, 0.6, 0.9, 0.7), 3
LAWS = (
    "bouc-wen",
    "dahl",
    "energy-based",
    "ferroelectric",
    "jiles-atherton",
    "lugre",
    "maxwell-slip",
    "prandtl-ishlinskii-modified",
    "preisach",
)
NONE = "none"
SIZES: Mapping[str, Callable[[np.random.Generator, float], dict[str, float]]] = {
    NONE: lambda rng, span: {},
    "output-lag": lambda rng, span: {"time_constant": rng.uniform(0.02, 0.06)},
    "input-lag": lambda rng, span: {"time_constant": rng.uniform(0.02, 0.06)},
    "creep": lambda rng, span: {"share": rng.uniform(0.15, 0.4), "time_constant": rng.uniform(0.03, 0.1), "decades": 1},
    "drift": lambda rng, span: {"rate": rng.uniform(0.03, 0.2) * span},
}
"""An effect's parameters; span : of the output;  records last 1.5 to 4"""


def drives(amplitude: float, rng: np.random.Generator) -> list[Record]:
    records = []
    for number, share in enumerate(AMPLITUDES):
        length = rng.uniform(1.5, 4.0)
        at, frequency = np.linspace(0.0, length, SAMPLES), int(rng.integers(1, 6)) / length
        growing = 1.0 if number % 2 else 0.4 + 0.6 * at / length
        minor = rng.uniform(0.0, 0.25) * np.sin(2.0 * np.pi * rng.uniform(2.0, 4.0) * frequency * at)
        u = share * amplitude * (growing * np.sin(2.0 * np.pi * frequency * at) + minor)
        records.append(Record(at, u, np.zeros(SAMPLES), f"run {number}"))
    return records


def case(law: str, effect: str, seed: int) -> tuple[Dataset, float]:
    """Records and the RMS of their noise."""
    rng = np.random.default_rng([seed, LAWS.index(law), [*SIZES].index(effect)])
    model = registry.build("models", law)
    example = model.example
    assert example is not None
    bare, records = System(model), drives(example.amplitude, rng)
    own = [example.parameters[q.name] * np.exp(SPREAD * rng.standard_normal()) for q in bare.parameters]
    alone = [bare.respond(one, np.array(own)[:, None])[:, 0] for one in records]
    system = System(model, registry.build_effects(model, () if effect == NONE else (effect,)))
    sizes = SIZES[effect](rng, float(np.ptp(np.concatenate(alone))))
    values = np.array([*own, *(sizes[q.name.partition(".")[2]] for q in system.parameters[len(own) :])])
    outputs = [system.respond(one, values[:, None])[:, 0] for one in records]
    noise = NOISE * float(np.ptp(np.concatenate(outputs)))
    noisy = [
        replace(one, output=y + noise * rng.standard_normal(y.size)) for one, y in zip(records, outputs, strict=True)
    ]
    return Dataset(tuple(noisy), (noisy[HELD_OUT].name,)), noise


def row(law: str, effect: str, seed: int) -> dict[str, object]:
    dataset, noise = case(law, effect, seed)
    began = time.perf_counter()
    found = diagnose(dataset, options=DiagnosisOptions(seed=seed))
    assert found.after.held_out is not None
    assert found.laws is not None
    ties = {tie.rival for tie in found.ties}
    wanted = set() if effect == NONE else {effect}
    return {
        "made by": law,
        "with": effect,
        "alone": found.laws.chosen,
        "found": found.model_name,
        "named": ", ".join(found.effects) or NONE,
        "law": found.model_name == law,
        "effect": wanted <= {*found.effects, *ties} and len(found.effects) == len(wanted),
        "held out / noise": found.after.held_out.rmse / noise,
        "seconds": time.perf_counter() - began,
    }


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("laws", nargs="*")
    parser.add_argument("--effects", default=",".join(SIZES))
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args(arguments)
    rows = []
    for law in given.laws or LAWS:
        for effect in given.effects.split(","):
            rows.append(row(law, effect, given.seed))
            print(", ".join(f"{key}: {value}" for key, value in rows[-1].items()), flush=True)
    table = pd.DataFrame(rows)
    print(
        table.drop(columns=["made by"])
        .groupby("with", sort=False)
        .agg(cases=("law", "size"), law=("law", "sum"), effect=("effect", "sum"), worst=("held out / noise", "max"))
        .to_string()
    )
    print(
        f"law and effect right: {int((table['law'] & table['effect']).sum())} of {len(table)}; worst time "
        f"{table['seconds'].max():.0f} s, median {table['seconds'].median():.0f} s"
    )


if __name__ == "__main__":
    main()
