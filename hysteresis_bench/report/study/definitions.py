"""What the words of the report mean, and where its numbers lie."""

from __future__ import annotations

from pathlib import Path

from hysteresis_bench import statistics
from hysteresis_bench.report.shared.blocks import Terms
from hysteresis_bench.report.shared.page import Section, files_beside
from hysteresis_bench.report.trials.best_known import EXACT
from hysteresis_bench.report.trials.latex import TABLES
from hysteresis_bench.study.results import PROVENANCE, PUBLISHED, RESPONSES, STUDY, SUMMARY, TRIALS

SUCCESS = "A success is a trial whose fitness is within 1 % of the best known to the study on the problem."
DEFINITIONS = (
    ("Fitness", "The study's loss on the fitted records, as the study file names it; lower is better."),
    ("Relative RMS", "RMSE over the largest |output − offset| measured."),
    ("Largest error", "Largest |simulated − measured| over the same."),
    ("Success", f"{SUCCESS} In brackets the 95 % Wilson interval of the rate."),
    (
        "Evaluations to success",
        "Median over all trials of the evaluations after which the best fitness was within that 1 %; a trial that "
        "never got there counts as infinite, so “not reached” means that half of them did not.",
    ),
    (
        "ERT",
        "Expected running time: all evaluations spent, up to the success or to the end of the trial, for each success.",
    ),
    (
        "Failed trials",
        "They rank as infinitely bad in medians, quartiles and tests; two failures tie. A search that returned early "
        "is no failure: its result counts, and its evaluations are the ones it spent.",
    ),
    (
        "Tests",
        "Friedman over all optimizers with the trials as blocks; then Wilcoxon signed-rank on pairs of trials that "
        "share their first points (zero differences after Pratt), corrected after Holm within a problem. Fitness "
        "within 0.01 % of the best known counts as the best known; on data without noise, so does every fit with a "
        f"relative RMS below {EXACT:g}. Below "
        f"{statistics.ENOUGH} trials no p-value is given.",
    ),
    (
        "A12",
        "Vargha and Delaney: how often a trial of this optimizer is better than one of the other, ties half. From 0.56 "
        "(0.44) a small effect, from 0.64 (0.36) medium, from 0.71 (0.29) large.",
    ),
)
FILES = {
    STUDY: "the study as it was run",
    TRIALS: "one row a trial",
    TABLES: "the main tables for a paper, LaTeX",
    SUMMARY: "one row an optimizer and problem: every number of the tables",
    RESPONSES: "measured and simulated samples of the best trials",
    PROVENANCE: "versions, machine, settings",
    PUBLISHED: "the paper's tables, claims and audit",
}


def section(folder: Path) -> Section:
    """folder : of the results, whose files are linked."""
    beside = files_beside({name: what for name, what in FILES.items() if (folder / name).is_file()})
    heading = "Definitions, and where every number comes from"
    return Section("definitions", heading, [Terms(DEFINITIONS), beside])
