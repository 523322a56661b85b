"""The report of a study."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from hysteresis_bench.data.csv_files import write_table
from hysteresis_bench.errors import UserError
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.report.trials.compared import Compared
from hysteresis_bench.report.trials.summary import summarise
from hysteresis_bench.study.afterwards.once_more import responses_once_more
from hysteresis_bench.study.kept_files.closing_files import CLOSING
from hysteresis_bench.study.results import REPORT, RESPONSES, SUMMARY, TRIALS, read_results
from hysteresis_bench.study.store import FILE

__all__ = ["summarise", "write_report"]


FROM_TABLES = "report-from-tables.html"
"""The page where the course of the searches was not kept, beside one that was written when it was there."""


@economical()
def write_report(folder: Path) -> Path:
    """Write summary.csv, claims.csv, tables.tex, figures/*.svg, report.html and closing/diagnosis.html into a results
    folder; returns the page.

    The same results give the same files. Where the responses of the best fits are not kept, they are computed once
    more. Where the course of the searches is not kept, a page and tables that are there have more than can be written
    again: they stay, and the page is `report-from-tables.html`.
    Raises UserError where the folder holds no study or no trials, or its published file has faults.
    """
    from hysteresis_bench.report.diagnosis.page import write_diagnosis_page
    from hysteresis_bench.report.study.page import CONTENT, study_page, write_tables

    results = read_results(folder)
    if results.kept_small and not (folder / RESPONSES).is_file() and responses_once_more(results):
        results = read_results(folder)
    if results.trials.empty:
        none = f"holds no trials: neither {FILE} nor {TRIALS} has any. Run the study again."
        raise UserError(str(folder), [*results.damages, none])
    richer = not results.traces and (folder / REPORT).is_file()
    closing = results.closing
    if closing and closing.finished and not closing.responses.empty and not richer:
        with suppress(*CONTENT):  # the section on it tells what is damaged
            write_diagnosis_page(folder / CLOSING, files_kept=not results.kept_small)
    compared = Compared.of(results)
    if not richer:
        write_table(folder / SUMMARY, compared.rows)
        write_tables(results, compared, folder)
    return study_page(results, compared, folder).write(folder / (FROM_TABLES if richer else REPORT))
