"""What halving and doubling each threshold of the diagnosis does to its verdicts, on made cases.

    python benchmarks/thresholds.py [--cases 18] [--seed 0] [--jobs 1]

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
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

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
    ("diagnosis.search.selection", "REACHED", RATIO),
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
CHANGES = tuple((*one, factor) for one in THRESHOLDS for factor in (0.5, 2.0))
MAKERS = ("bouc-wen", "jiles-atherton", "prandtl-ishlinskii-modified", "dahl", "ferroelectric")
FITTED, HELD_OUT = ("slow", "fast", "nested", "sweep"), ("mixed",)


class Case(NamedTuple):
    """The law that is asked about, and what makes the records. Records are measured where they are diagnosed."""

    law: str
    settings: dict[str, object]
    seed: int
    number: int

    def dataset(self) -> Dataset:
        rig = registry.build("rigs", "hidden-effects", self.settings)
        records = measure(rig, [*FITTED, *HELD_OUT], "thresholds", self.seed, self.number).records
        return Dataset(records, HELD_OUT)


class Verdict(NamedTuple):
    word: str
    named: frozenset[str]
    stand_ins: frozenset[str]
    ties: frozenset[tuple[str, str]]

    def claims_as(self, other: Verdict) -> bool:
        """Does it claim the same as the other one? Ties and what stands in for the law claim nothing."""
        return (self.word, self.named) == (other.word, other.named)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cases", type=int, default=18)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1)
    told = parser.parse_args()
    console = Console(width=120, highlight=False)
    changes: list[list[str]] = [[] for _ in CHANGES]
    names = 0
    with ProcessPoolExecutor(told.jobs) as pool:
        asked = {pool.submit(changed_by, case): case for case in made(told.cases, told.seed)}
        for done, one in enumerate(as_completed(asked), 1):
            by, case = one.result(), f"{asked[one].number} ({asked[one].law})"
            for change, named in by.items():
                changes[change].append(f"{case}{' claims' if named else ''}")
                names += named
            words = (f"{_words(change)}{' (claims)' if named else ''}" for change, named in by.items())
            console.print(f"case {case}, {done} of {told.cases}: {'; '.join(words) or 'none'}")
    console.print(
        "Verdicts that change where a threshold is halved, and doubled; of these with 'claims', what is claimed"
    )
    for change, numbers in enumerate(changes):
        console.print(f"{_words(change):64s} {len(numbers):2d}   {', '.join(numbers) or 'none'}")
    shares = [len(one) / told.cases for one in changes]
    mean, claims = np.mean(shares), names / (len(CHANGES) * told.cases)
    console.print(
        f"worst {100 * max(shares):.1f} %, mean {100 * mean:.1f} % of the verdicts, asked at most 2 %; "
        f"what is claimed: mean {100 * claims:.1f} %"
    )


def changed_by(case: Case) -> dict[int, bool]:
    """Which changes give one case another verdict, and whether what is claimed is another."""
    modules = [
        importlib.import_module(one.name)
        for room in ROOMS
        for one in pkgutil.walk_packages(importlib.import_module(room).__path__, f"{room}.")
    ]
    by, dataset = {}, case.dataset()
    with tempfile.TemporaryDirectory() as folder:
        kept = Journal(Path(folder) / "fits.jsonl", "case")
        plain = verdict(dataset, case.law, kept)
        for change, (home, name, times, factor) in enumerate(CHANGES):
            value = getattr(importlib.import_module(f"{HOME}.{home}"), name)
            with changed(modules, f"{HOME}.{home}", name, times(value, factor)):
                found = verdict(dataset, case.law, kept)
            if found != plain:
                by[change] = not found.claims_as(plain)
    return by


def _words(change: int) -> str:
    home, name, times, factor = CHANGES[change]
    value = getattr(importlib.import_module(f"{HOME}.{home}"), name)
    return f"{home}.{name} {value:g} to {times(value, factor):.4g}"


def made(count: int, seed: int) -> Iterator[Case]:
    rng = np.random.default_rng([seed, 20261122])
    for number in range(count):
        law = MAKERS[rng.integers(len(MAKERS))]
        asked = MAKERS[rng.integers(len(MAKERS))] if number % 3 == 2 else law
        settings = {"model": law, "hide": int(rng.integers(0, 3)), "draw": int(rng.integers(10**6))}
        yield Case(asked, settings | {"other": number % 3 == 1}, seed, number)


def verdict(dataset: Dataset, law: str, kept: Journal) -> Verdict:
    found = diagnose(dataset, law, options=DiagnosisOptions(jobs=1, kept=kept))
    ties = frozenset((tie.effect, tie.rival) for tie in found.ties)
    return Verdict(found.verdict, frozenset(found.effects), frozenset(found.stand_ins), ties)


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
