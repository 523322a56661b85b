"""What halving and doubling each threshold of the diagnosis does to its verdicts, on made cases.

    python benchmarks/thresholds.py [--cases 18] [--seed 0]

A verdict is what is named, tied, left as a curve, or told to stand in for the law, and whether anything is left. Of a
ratio that means something from 1 on, such as 1.06, the excess over 1 is halved and doubled; of a share of a whole, what
it is to the rest, as half of it doubled is the whole, which nothing reaches. Every third case has the effects by other
formulas, every third one is asked about a law that did not make it. Fits do not depend on these thresholds: what was
fitted once is kept for the next one. Targets: 2 % of the verdicts.
"""

from __future__ import annotations

import argparse
import ast
import importlib
import pkgutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import ModuleType

import numpy as np
from rich.console import Console

import hysteresis_bench
from hysteresis_bench import DiagnosisOptions, diagnose, registry
from hysteresis_bench.commands.data.journal import Journal
from hysteresis_bench.signals import Dataset
from hysteresis_bench.study.problems import measure

HOME = hysteresis_bench.__name__
ROOMS = (f"{HOME}.diagnosis", f"{HOME}.fit")


def counted_from(origin: float, value: float, factor: float) -> float:
    return origin + factor * (value - origin)


def share(value: float, factor: float) -> float:
    """To the rest."""
    return factor * value / (1.0 - value + factor * value)


RATIO, NUMBER = partial(counted_from, 1.0), partial(counted_from, 0.0)
THRESHOLDS: tuple[tuple[str, str, Callable[[float, float], float]], ...] = (
    ("diagnosis.search.selection", "LEVEL", NUMBER),
    ("diagnosis.search.selection", "MATTERS", RATIO),
    ("diagnosis.search.selection", "SHARE", share),
    ("diagnosis.search.selection", "NAMED", share),
    ("diagnosis.search.selection", "CLOSE", NUMBER),
    ("diagnosis.search.selection", "ALIKE", RATIO),
    ("diagnosis.search.selection", "MISFIT", RATIO),
    ("fit.unseen.advantage", "CLEAR", NUMBER),
    ("diagnosis.evidence.noise_floor", "WRONG", RATIO),
    ("diagnosis.evidence.memory", "MATERIAL", NUMBER),
    ("diagnosis.findings.remainder", "REMAINS", RATIO),
)
"""Module, name, and what becomes of a value times a factor."""
MAKERS = ("bouc-wen", "jiles-atherton", "prandtl-ishlinskii-modified", "dahl", "ferroelectric")
FITTED, HELD_OUT = ("slow", "fast", "nested", "sweep"), ("mixed",)

Verdict = tuple[object, ...]
Case = tuple[str, Dataset]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cases", type=int, default=18)
    parser.add_argument("--seed", type=int, default=0)
    told = parser.parse_args()
    modules = [
        importlib.import_module(one.name)
        for room in ROOMS
        for one in pkgutil.walk_packages(importlib.import_module(room).__path__, f"{room}.")
    ]
    cases = list(made(told.cases, told.seed))
    console = Console(width=100, highlight=False)
    with tempfile.TemporaryDirectory() as folder:
        kept = [Journal(Path(folder) / f"{number}.jsonl", str(number)) for number in range(len(cases))]
        plain = [verdict(case, journal) for case, journal in zip(cases, kept, strict=True)]
        console.print(f"{len(cases)} cases; verdicts that change where a threshold is halved, and doubled")
        worst = 0.0
        for home, name, times in THRESHOLDS:
            value = getattr(importlib.import_module(f"{HOME}.{home}"), name)
            row = []
            for factor in (0.5, 2.0):
                with changed(modules, f"{HOME}.{home}", name, times(value, factor)):
                    found = [verdict(case, journal) for case, journal in zip(cases, kept, strict=True)]
                row.append([number for number, pair in enumerate(zip(plain, found, strict=True)) if pair[0] != pair[1]])
            worst = max(worst, *(len(one) / len(cases) for one in row))
            told_cases = "; ".join(", ".join(f"{n} ({cases[n][0]})" for n in one) or "none" for one in row)
            console.print(f"{home + '.' + name:38s} {value:<7g} {len(row[0]):2d} {len(row[1]):2d}   {told_cases}")
        console.print(f"worst: {100 * worst:.1f} % of the verdicts, asked at most 2 %")


def made(count: int, seed: int) -> Iterator[Case]:
    """The law that is asked about, and the records."""
    rng = np.random.default_rng([seed, 20261122])
    for number in range(count):
        law = MAKERS[rng.integers(len(MAKERS))]
        asked = MAKERS[rng.integers(len(MAKERS))] if number % 3 == 2 else law
        settings = {"model": law, "hide": int(rng.integers(0, 3)), "draw": int(rng.integers(10**6))}
        rig = registry.build("rigs", "hidden-effects", settings | {"other": number % 3 == 1})
        dataset = measure(rig, [*FITTED, *HELD_OUT], "thresholds", seed, number)
        yield asked, Dataset(dataset.records, HELD_OUT)


def verdict(case: Case, kept: Journal) -> Verdict:
    asked, dataset = case
    found = diagnose(dataset, asked, options=DiagnosisOptions(jobs=1, kept=kept))
    ties = frozenset((tie.effect, tie.rival) for tie in found.ties)
    return found.verdict, frozenset(found.effects), frozenset(found.stand_ins), ties


@contextmanager
def changed(modules: Sequence[ModuleType], home: str, name: str, value: float) -> Iterator[None]:
    """The constant, in its module and wherever it was imported from there."""
    known = {module: getattr(module, name) for module in modules if module.__name__ == home or _has(module, home, name)}
    try:
        for module in known:
            setattr(module, name, value)
        yield
    finally:
        for module, before in known.items():
            setattr(module, name, before)


def _has(module: ModuleType, home: str, name: str) -> bool:
    tree = ast.parse(Path(module.__file__ or "").read_text(encoding="utf-8"))
    froms = (node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module == home)
    return any(alias.name == name for node in froms for alias in node.names)


if __name__ == "__main__":
    main()
