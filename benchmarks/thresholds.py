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
from itertools import islice
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
CHANGES = tuple((*one, factor) for one in THRESHOLDS for factor in (0.5, 2.0))
MAKERS = ("bouc-wen", "jiles-atherton", "prandtl-ishlinskii-modified", "dahl", "ferroelectric")
FITTED, HELD_OUT = ("slow", "fast", "nested", "sweep"), ("mixed",)

Verdict = tuple[object, ...]
Case = tuple[str, Dataset]


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
        asked = [pool.submit(changed_by, told.cases, told.seed, number) for number in range(told.cases)]
        for done, one in enumerate(as_completed(asked), 1):
            number, law, by = one.result()
            for change, named in by.items():
                changes[change].append(f"{number} ({law}{', claims' if named else ''})")
                names += named
            words = (f"{_words(change)}{' (claims)' if named else ''}" for change, named in by.items())
            console.print(f"case {number} ({law}), {done} of {told.cases}: {'; '.join(words) or 'none'}")
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


def changed_by(count: int, seed: int, number: int) -> tuple[int, str, dict[int, bool]]:
    """Which changes give one case another verdict, and whether what is claimed is another."""
    modules = [
        importlib.import_module(one.name)
        for room in ROOMS
        for one in pkgutil.walk_packages(importlib.import_module(room).__path__, f"{room}.")
    ]
    case = next(islice(made(count, seed), number, None))
    by = {}
    with tempfile.TemporaryDirectory() as folder:
        kept = Journal(Path(folder) / "fits.jsonl", str(number))
        plain = verdict(case, kept)
        for change, (home, name, times, factor) in enumerate(CHANGES):
            value = getattr(importlib.import_module(f"{HOME}.{home}"), name)
            with changed(modules, f"{HOME}.{home}", name, times(value, factor)):
                found = verdict(case, kept)
            if found != plain:
                by[change] = found[:2] != plain[:2]
    return number, case[0], by


def _words(change: int) -> str:
    home, name, times, factor = CHANGES[change]
    value = getattr(importlib.import_module(f"{HOME}.{home}"), name)
    return f"{home}.{name} {value:g} to {times(value, factor):.4g}"


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
