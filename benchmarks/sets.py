"""Would a beam over sets of effects find a better one than the search ends with?

    python benchmarks/sets.py [--cases 40] [--first 1] [--hide 2]

Made cases hide `--hide` effects around one of five laws, every second one by other formulas; the records are those of
the rig `hidden-effects`. After the search, the `WIDTH` best single effects are extended by every other one, and the
best pairs of these again, up to as many as the search claims. Told is every set of no more claims that predicts samples
left out clearly better than the search's: one that the search had fitted, and one that only the beam comes upon.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable

from rich.console import Console

from hysteresis_bench import DiagnosisOptions, registry
from hysteresis_bench.diagnosis.around import searched
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Hypothesis
from hysteresis_bench.diagnosis.question import Question
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.sets import claims, takes_the_place
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.signals import Dataset
from hysteresis_bench.study.problems import measure

LAWS = ("bouc-wen", "jiles-atherton", "free-energy", "ferroelectric", "dahl")
FITTED, HELD_OUT = ("slow", "fast", "nested", "sweep"), ("mixed",)
WIDTH = 3
"""Sets of every size that are followed."""


def better(found: Found, known: Iterable[Hypothesis]) -> list[Hypothesis]:
    """Those that should have taken the place of what was selected."""
    return [one for one in known if takes_the_place(found.selection, one, found.best)]


def beam(found: Found) -> list[Hypothesis]:
    """Sets of as many effects as were selected, at most."""
    selection, level, every = found.selection, [found.base], list[Hypothesis]()
    for _ in range(claims(found.best)):
        asked = [(one, name) for one in level for name in selection.candidates if name not in one.names]
        tried = {one.names: one for system, name in asked for one in selection.with_each(system, [name])}
        every += tried.values()
        level = sorted(tried.values(), key=lambda one: one.cv_rmse)[:WIDTH]
    return every


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=40)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--hide", type=int, default=2)
    told = parser.parse_args()
    console = Console(width=140, highlight=False)
    counts = {"search": 0, "beam": 0}
    for number in range(told.first, told.first + told.cases):
        law = LAWS[number % len(LAWS)]
        settings = {"model": law, "hide": told.hide, "draw": number, "other": bool(number // len(LAWS) % 2)}
        data = measure(registry.build("rigs", "hidden-effects", settings), [*FITTED, *HELD_OUT], number).split(HELD_OUT)
        blind = Dataset(data.records, HELD_OUT)
        with economical():
            found = searched(blind, Question(law, options=DiagnosisOptions(jobs=1))).found
            missed = {"search": better(found, found.selection.known.values())}
            missed["beam"] = [one for one in better(found, beam(found)) if one not in missed["search"]]
        for who, sets in missed.items():
            counts[who] += bool(sets)
            for one in sets:
                names, ratio = sorted(one.names - {*registry.OFFSETS}), one.cv_rmse / found.best.cv_rmse
                console.print(f"{number}, {law}: {', '.join(names)} leaves {ratio:.3f} times as much ({who})")
    console.print(
        f"{told.cases} cases: in {counts['search']} the search had fitted a better set, in {counts['beam']} only a "
        f"beam of {WIDTH} comes upon one"
    )


if __name__ == "__main__":
    main()
