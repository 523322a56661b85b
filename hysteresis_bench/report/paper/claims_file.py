"""The verdicts on a paper's claims as a table that other programs read."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.report.paper.claims import Judged

CLAIMS = "claims.csv"


def write_claims(folder: Path, judged: Sequence[Judged]) -> None:
    """One row a claim and problem, ablations among them; no file where nothing was judged."""
    rows = [_row(found) for found in judged if found.medians]
    if rows:
        write_table(folder / CLAIMS, pd.DataFrame(rows))


def _row(judged: Judged) -> dict[str, object]:
    claim, found = judged.claim, judged.found
    assert judged.medians is not None
    assert found is not None
    practical = found.practical
    return {
        "problem": judged.problem,
        "claim": claim.says,
        "where": claim.where,
        "ablation": claim.ablation,
        "better": claim.better,
        "worse": claim.worse,
        "metric": claim.metric,
        "verdict": judged.verdict,
        "why": judged.why,
        "median_better": judged.medians[0],
        "median_worse": judged.medians[1],
        "p": found.p,
        "a12": found.a12,
        "a12_low": found.low,
        "a12_high": found.high,
        "probability_better": practical.better if practical else None,
        "probability_equivalent": practical.equivalent if practical else None,
        "probability_worse": practical.worse if practical else None,
        "over": judged.over,
    }
