"""The report of a study."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from hysteresis_bench.errors import UserError
from hysteresis_bench.report.trials.summary import other_budgets, summarise
from hysteresis_bench.study.afterwards.closing_files import CLOSING
from hysteresis_bench.study.results import REPORT, SUMMARY, read_results

__all__ = ["summarise", "write_report"]


def write_report(folder: Path) -> Path:
    """Write summary.csv, figures/*.svg, report.html and closing/diagnosis.html into a results folder; returns the page.

    The same results give the same files. Raises UserError where the folder holds no study or no trials, or its
    published file has faults.
    """
    from hysteresis_bench.report.diagnosis.page import write_diagnosis_page
    from hysteresis_bench.report.study.page import study_page

    results = read_results(folder)
    if results.trials.empty:
        raise UserError(str(folder), "holds no trials: its trials.sqlite is missing or empty. Run the study again.")
    if results.closing and results.closing.finished:
        write_diagnosis_page(folder / CLOSING)
    summary = summarise(results)
    parts = [summary, *(summarise(results, budget) for budget in other_budgets(results))]
    pd.concat(part for part in parts if not part.empty).to_csv(folder / SUMMARY, index=False)
    return study_page(results, summary, folder).write(folder / REPORT)
