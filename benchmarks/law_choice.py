"""Does the law that is chosen predict other excitations about as well as the best one? On made data.

    python benchmarks/law_choice.py [DRIVE ...] [--seeds 1]

Every law, and sums of two laws, which no law is, are driven by several amplitudes with noise of 0.1, 0.3 or 1 % of the
range. The error of the chosen law on what was not fitted, free of noise, is told as a multiple of the least error
among all laws there: with the law that made the data among them, and without it and its kin.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np
import pandas as pd

from hysteresis_bench import compare, registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.preparation import with_held_out
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.signals import Dataset, Record

NOISES = (0.001, 0.003, 0.01)
SPREAD = 0.25
"""Of the logarithms of the parameters about a law's own example."""
GOOD = 1.2
MAGNETIC = ("jiles-atherton-clamped", "jiles-atherton-pinning")
BOUC_WEN = ("bouc-wen", "bouc-wen-generalized", "dahl", "lugre")
PLAYS = ("prandtl-ishlinskii-modified", "maxwell-slip")
KIN = (MAGNETIC, BOUC_WEN, PLAYS)
LAGGING = (*MAGNETIC, "energy-based", "ferroelectric", "preisach", "prandtl-ishlinskii-modified")
FORCES = (*BOUC_WEN, "maxwell-slip")
LAWS = (*LAGGING, *FORCES, "preisach-hats")
MADE = (*LAGGING, *FORCES, *("+".join(pair) for group in (LAGGING, FORCES) for pair in combinations(group, 2)))


def sine(phase: Array) -> Array:
    return np.sin(2.0 * np.pi * phase)


def minor_loops(phase: Array) -> Array:
    return 0.6 * sine(phase) + 0.4 * sine(3.1 * phase)


def growing(phase: Array) -> Array:
    return sine(phase) * np.linspace(0.15, 1.0, phase.size)


def decaying(phase: Array) -> Array:
    return sine(phase) * np.linspace(1.0, 0.15, phase.size)


def steep(phase: Array) -> Array:
    return sine(phase) * np.geomspace(0.03, 1.0, phase.size)


def once(phase: Array) -> Array:
    return 0.5 - 0.5 * np.cos(2.0 * np.pi * phase)


Run = tuple[float, float, Callable[[Array], Array], bool]
DRIVES: Mapping[str, Sequence[Run]] = {
    "two amplitudes": ((0.1, 2.25, sine, False), (1.0, 2.25, sine, False), (0.2, 2.25, sine, True)),
    "nested amplitudes": (
        *((share, 2.25, sine, False) for share in (0.1, 0.3, 1.0)),
        *((share, 2.25, sine, True) for share in (0.2, 0.6)),
    ),
    "one amplitude": ((1.0, 2.25, sine, False), (0.4, 2.25, sine, True)),
    "decaying": ((0.9, 8.0, decaying, False), (1.0, 2.25, sine, True)),
    "growing": ((1.0, 9.0, growing, False),),
    "steep": ((1.0, 9.0, steep, False),),
    "once": ((1.0, 1.0, once, False),),
    "once and more": ((1.0, 1.6, once, False),),
    "minor loops": ((1.0, 6.0, minor_loops, False),),
    "several shapes": (
        (1.0, 3.0, minor_loops, False),
        (0.7, 3.0, minor_loops, False),
        (0.5, 2.2, sine, False),
        (0.85, 3.0, minor_loops, True),
        (0.6, 2.2, sine, True),
    ),
}
"""Amplitude, as a share of the law's own, cycles, shape, and whether it is held out: the last third, where none is."""
SAMPLES, FEWEST = 50, 250
"""A cycle, and of a lone record."""


def response(made: str, rng: np.random.Generator) -> tuple[Callable[[Array, Array], Array], float]:
    """Time and share of the amplitude to output, every part of a sum scaled to one; and the amplitude."""
    parts = []
    for name in made.split("+"):
        model = registry.build("models", name)
        system, example = System(model), model.example
        assert example is not None
        values = [example.parameters[q.name] * np.exp(SPREAD * rng.standard_normal()) for q in system.parameters]
        parts.append((system, example.amplitude, np.array(values)[:, None]))

    def simulated(system: System, time: Array, u: Array, values: Array) -> Array:
        found: Array = system.simulate(Record(time, u, None).signal, values)[:, 0]
        return found

    whole = np.linspace(0.0, 2.25, 200)
    sizes = [np.ptp(simulated(system, whole, top * sine(whole), values)) for system, top, values in parts]

    def summed(time: Array, share: Array) -> Array:
        outputs = [simulated(system, time, top * share, values) for system, top, values in parts]
        found: Array = sum(output / size for output, size in zip(outputs, sizes, strict=True))
        return found

    return summed, parts[0][1] if len(parts) == 1 else 1.0


def case(made: str, drive: str, seed: int) -> tuple[Dataset, float]:
    """Records and the RMS of their noise, which those that are held out by name have not."""
    rng = np.random.default_rng([seed, MADE.index(made), [*DRIVES].index(drive)])
    noise, (respond, amplitude), records = float(rng.choice(NOISES)), response(made, rng), []
    for number, (share, cycles, shape, _) in enumerate(DRIVES[drive]):
        fewest = FEWEST if len(DRIVES[drive]) == 1 else 0
        time = np.linspace(0.0, cycles, max(round(SAMPLES * cycles), fewest))
        drawn = share * rng.uniform(0.85, 1.0) * shape(time)
        records.append(Record(time, amplitude * drawn, respond(time, drawn), f"run {number}"))
    held_out = tuple(record.name for record, run in zip(records, DRIVES[drive], strict=True) if run[3])
    level = noise * max(float(np.ptp(record.measured)) for record in records)
    noisy = [replace(r, output=r.measured + level * rng.standard_normal(r.time.size)) for r in records]
    seen = [own if own.name in held_out else one for own, one in zip(records, noisy, strict=True)]
    return with_held_out(Dataset(tuple(seen), held_out))[0], level


def answers(made: str, drive: str, seed: int) -> Iterator[tuple[str, str, float]]:
    """Whether the maker is among the laws, the one that is chosen, and its error over the best one's."""
    dataset, noise = case(made, drive, seed)
    kin = {made, *(name for group in KIN if made in group for name in group)}
    laws = {"sum": LAWS} if "+" in made else {"known": LAWS, "unknown": tuple(n for n in LAWS if n not in kin)}
    for kind, names in laws.items():
        found = compare(dataset, names, options=DiagnosisOptions(seed=seed, laws=names, jobs=1))
        rows = found.table[found.table["law"].isin(names)].set_index("law")["held_out"]
        least = 0.3 * noise  # below it a difference does not matter
        yield kind, found.chosen, (float(rows.get(found.chosen, np.inf)) + least) / (float(rows.min()) + least)


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("drives", nargs="*")
    parser.add_argument("--seeds", type=int, default=1)
    given = parser.parse_args(arguments)
    ratios = defaultdict(list)
    for drive in given.drives or DRIVES:
        for made in MADE:
            for seed in range(given.seeds):
                for kind, chosen, ratio in answers(made, drive, seed):
                    ratios[kind, drive].append(ratio)
                    print(f"{drive}, {made}, maker {kind}: {chosen}, {ratio:.2f} times the best", flush=True)
    rows = [
        (kind, drive, len(one), np.mean(np.array(one) < GOOD), np.mean(one), np.max(one))
        for (kind, drive), one in ratios.items()
    ]
    print(pd.DataFrame(rows, columns=["maker", "drive", "cases", f"below {GOOD}", "mean", "worst"]).to_string())


if __name__ == "__main__":
    main()
