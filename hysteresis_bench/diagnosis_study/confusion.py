"""Hidden effects against what was claimed for them, counted over cases."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from hysteresis_bench.diagnosis_study.case import Case

NOTHING = "nothing"


def confusion(cases: Sequence[Case]) -> pd.DataFrame:
    """Cases by hidden effect (rows) and what was claimed for it (columns).

    A hidden effect that was named counts under its name; one that was not, under every claim that was extra or
    tied in its case, or under "nothing". Extra claims of cases with nothing missed stand in the row "nothing".
    """
    pairs = []
    for case in (case for case in cases if case.status == "done"):
        named, wrong = case.named.split(), case.extra.split()
        spare = [name for name in case.claimed.split() if not any(name in entry.split("|") for entry in named)]
        pairs += [(entry, next(n for n in entry.split("|") if n in case.claimed.split())) for entry in named]
        for entry in [*case.tied.split(), *case.missed.split()]:
            pairs += [(entry, name) for name in spare or [NOTHING]]
        if not case.missed:
            pairs += [(NOTHING, name) for name in wrong]
        if not case.hidden and not case.claimed:
            pairs.append((NOTHING, NOTHING))
    table = pd.DataFrame(pairs, columns=["hidden", "claimed"])
    return pd.crosstab(table["hidden"], table["claimed"])
