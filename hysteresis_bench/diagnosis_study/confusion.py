"""Hidden effects against what was claimed for them, counted over cases."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from hysteresis_bench.diagnosis_study.case import Case

NOTHING = "nothing"
"""Row of the cases with nothing hidden; column of what was missed while nothing was claimed in its place."""

BESIDE = "beside what was hidden"
"""Row of the claims that were extra in cases of which nothing that was hidden was missed."""


def confusion(cases: Sequence[Case]) -> pd.DataFrame:
    """Cases by hidden effect (rows) and what was claimed for it (columns).

    A hidden effect that was named counts under its name; one that was not, under every claim that was extra or
    tied in its case, or under NOTHING. Extra claims of cases with nothing missed stand in the row BESIDE, and in the
    row NOTHING where nothing was hidden.
    """
    pairs = []
    for case in (case for case in cases if case.status == "done"):
        named, wrong = case.named.split(), case.extra.split()
        spare = [name for name in case.claimed.split() if not any(name in entry.split("|") for entry in named)]
        pairs += [(entry, next(n for n in entry.split("|") if n in case.claimed.split())) for entry in named]
        for entry in [*case.tied.split(), *case.missed.split()]:
            pairs += [(entry, name) for name in spare or [NOTHING]]
        if not case.missed:
            pairs += [(BESIDE if case.hidden else NOTHING, name) for name in wrong]
        if not case.hidden and not case.claimed:
            pairs.append((NOTHING, NOTHING))
    table = pd.DataFrame(pairs, columns=["hidden", "claimed"])
    return pd.crosstab(table["hidden"], table["claimed"])
