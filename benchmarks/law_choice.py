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
from dataclasses import dataclass, replace
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


@dataclass(frozen=True)
class Run:
    """share : amplitude, of the law's own;  held_out : the last third, where no run of a drive is
    frequency : cycles a unit of time
    """

    share: float
    cycles: float
    shape: Callable[[Array], Array] = sine
    held_out: bool = False
    frequency: float = 1.0


def several_frequencies(held_out: int) -> tuple[Run, ...]:
    """One amplitude at frequencies like those of a ferroelectric tester; held_out : which of them."""
    return tuple(Run(1.0, 2.25, held_out=k == held_out, frequency=f) for k, f in enumerate((0.4, 0.6, 1.0, 1.6, 2.5)))


DRIVES: Mapping[str, Sequence[Run]] = {
    "two amplitudes": (Run(0.1, 2.25), Run(1.0, 2.25), Run(0.2, 2.25, held_out=True)),
    "nested amplitudes": (
        *(Run(share, 2.25) for share in (0.1, 0.3, 1.0)),
        *(Run(share, 2.25, held_out=True) for share in (0.2, 0.6)),
    ),
    "one amplitude": (Run(1.0, 2.25), Run(0.4, 2.25, held_out=True)),
    "decaying": (Run(0.9, 8.0, decaying), Run(1.0, 2.25, held_out=True)),
    "growing": (Run(1.0, 9.0, growing),),
    "steep": (Run(1.0, 9.0, steep),),
    "once": (Run(1.0, 1.0, once),),
    "once and more": (Run(1.0, 1.6, once),),
    "minor loops": (Run(1.0, 6.0, minor_loops),),
    "several shapes": (
        Run(1.0, 3.0, minor_loops),
        Run(0.7, 3.0, minor_loops),
        Run(0.5, 2.2),
        Run(0.85, 3.0, minor_loops, held_out=True),
        Run(0.6, 2.2, held_out=True),
    ),
    "middle frequency": several_frequencies(2),
    "highest frequency": several_frequencies(4),
}
LAG, DELAY = "input-lag", 0.03
"""What stands before every law where frequencies differ, and is told to `compare`; cycles at frequency 1."""
SAMPLES, FEWEST = 50, 250
"""A cycle, and of a lone record."""


def response(
    made: str, effects: Sequence[str], rng: np.random.Generator
) -> tuple[Callable[[Array, Array], Array], float]:
    """Time and share of the amplitude to output, every part of a sum scaled to one; and the amplitude."""
    parts = []
    for name in made.split("+"):
        model = registry.build("models", name)
        bare, example = System(model), model.example
        assert example is not None
        values = [example.parameters[q.name] * np.exp(SPREAD * rng.standard_normal()) for q in bare.parameters]
        system = System(model, registry.build_effects(model, effects))
        parts.append((system, example.amplitude, np.array([*values, *(DELAY for _ in effects)])[:, None]))

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


def effects(drive: str) -> tuple[str, ...]:
    """That stand around the law, known."""
    return (LAG,) if any(run.frequency != 1.0 for run in DRIVES[drive]) else ()


def case(made: str, drive: str, seed: int) -> tuple[Dataset, float]:
    """Records and the RMS of their noise, which those that are held out by name have not."""
    rng = np.random.default_rng([seed, MADE.index(made), [*DRIVES].index(drive)])
    noise, (respond, amplitude), records = float(rng.choice(NOISES)), response(made, effects(drive), rng), []
    for number, run in enumerate(DRIVES[drive]):
        fewest = FEWEST if len(DRIVES[drive]) == 1 else 0
        phase = np.linspace(0.0, run.cycles, max(round(SAMPLES * run.cycles), fewest))
        drawn, time = run.share * rng.uniform(0.85, 1.0) * run.shape(phase), phase / run.frequency
        records.append(Record(time, amplitude * drawn, respond(time, drawn), f"run {number}"))
    held_out = tuple(record.name for record, run in zip(records, DRIVES[drive], strict=True) if run.held_out)
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
        found = compare(dataset, names, effects(drive), options=DiagnosisOptions(seed=seed, laws=names, jobs=1))
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
