"""Is the law found beside an effect that is not known? `diagnose` without a model, on made data.

    python benchmarks/law_beside_effects.py [LAW ...] [--effects NONE,output-lag,...] [--seed 0] [--records one]

Every law makes records, one of them held out, alone and with one effect of a random size; the noise is 0.3 % of the
range. There are five at different rates and amplitudes; or one is fitted, whose amplitude grows or falls, and one of
constant amplitude held out. Told are the law that is found, what is named, what is left of the record that was held out
over its noise, and the time that it took.
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
LENGTH, LONGER = 8.0, 1600
"""Of the records where one is fitted, and its samples."""
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


def several(amplitude: float, rng: np.random.Generator) -> tuple[list[Record], int]:
    """Records without an output, and which is held out."""
    records = []
    for number, share in enumerate(AMPLITUDES):
        length = rng.uniform(1.5, 4.0)
        at, frequency = np.linspace(0.0, length, SAMPLES), int(rng.integers(1, 6)) / length
        growing = 1.0 if number % 2 else 0.4 + 0.6 * at / length
        minor = rng.uniform(0.0, 0.25) * np.sin(2.0 * np.pi * rng.uniform(2.0, 4.0) * frequency * at)
        u = share * amplitude * (growing * np.sin(2.0 * np.pi * frequency * at) + minor)
        records.append(Record(at, u, np.zeros(SAMPLES), f"run {number}"))
    return records, HELD_OUT


def one(amplitude: float, rng: np.random.Generator) -> tuple[list[Record], int]:
    """As `several`: one is fitted."""
    at = np.linspace(0.0, LENGTH, LONGER)
    falling, growing = 1.0 - np.clip(at / LENGTH - 0.2, 0.0, 0.8), 0.35 + 0.65 * np.clip(1.6 * at / LENGTH, 0.0, 1.0)
    changing = falling if rng.random() < 0.5 else growing
    records = []
    for name, envelope in (("changing", 0.95 * changing), ("constant", np.full(LONGER, 0.85))):
        u = amplitude * envelope * np.sin(2.0 * np.pi * rng.uniform(0.8, 1.4) * at)
        records.append(Record(at, u, np.zeros(LONGER), name))
    return records, 1


DRIVES = {"several": several, "one": one}


def case(law: str, effect: str, seed: int, drives: str = "several") -> tuple[Dataset, float]:
    """Records and the RMS of their noise."""
    rng = np.random.default_rng([seed, LAWS.index(law), [*SIZES].index(effect)])
    model = registry.build("models", law)
    example = model.example
    assert example is not None
    bare, (records, held_out) = System(model), DRIVES[drives](example.amplitude, rng)
    own = [example.parameters[q.name] * np.exp(SPREAD * rng.standard_normal()) for q in bare.parameters]
    alone = [bare.respond(record, np.array(own)[:, None])[:, 0] for record in records]
    system = System(model, registry.build_effects(model, () if effect == NONE else (effect,)))
    sizes = SIZES[effect](rng, float(np.ptp(np.concatenate(alone))))
    values = np.array([*own, *(sizes[q.name.partition(".")[2]] for q in system.parameters[len(own) :])])
    outputs = [system.respond(record, values[:, None])[:, 0] for record in records]
    noise = NOISE * float(np.ptp(np.concatenate(outputs)))
    noisy = [
        replace(record, output=y + noise * rng.standard_normal(y.size))
        for record, y in zip(records, outputs, strict=True)
    ]
    return Dataset(tuple(noisy), (noisy[held_out].name,)), noise


def row(law: str, effect: str, seed: int, drives: str) -> dict[str, object]:
    dataset, noise = case(law, effect, seed, drives)
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
    parser.add_argument("--records", choices=DRIVES, default="several")
    given = parser.parse_args(arguments)
    rows = []
    for law in given.laws or LAWS:
        for effect in given.effects.split(","):
            rows.append(row(law, effect, given.seed, given.records))
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
