"""Reports: read results, write HTML, CSV and figures. Computes no trial."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from hysteresis_bench.csv_files import write_table
from hysteresis_bench.report.study.summary import other_budgets, summarise
from hysteresis_bench.study.results import REPORT, SUMMARY, read_results

__all__ = ["summarise", "write_report"]


def write_report(folder: Path) -> Path:
    """Write summary.csv, figures/*.svg and report.html into a results folder; returns the page.

    The same results give the same files. Raises UserError where the folder holds no study or its published
    file has faults.
    """
    from hysteresis_bench.report.study.page import study_page

    results = read_results(folder)
    summary = summarise(results)
    parts = [summary, *(summarise(results, budget) for budget in other_budgets(results))]
    write_table(folder / SUMMARY, pd.concat(part for part in parts if not part.empty))
    page = folder / REPORT
    page.write_text(study_page(results, summary, folder), encoding="utf-8")
    return page
