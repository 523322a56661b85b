"""What the words of the report mean, and where its numbers lie."""

from __future__ import annotations

from pathlib import Path

from hysteresis_bench import statistics
from hysteresis_bench.report.paper.claims_file import CLAIMS
from hysteresis_bench.report.shared.blocks import Terms
from hysteresis_bench.report.shared.page import Section, files_beside
from hysteresis_bench.report.trials.best_known import EXACT
from hysteresis_bench.report.trials.latex import TABLES
from hysteresis_bench.study.kept_files.courses import COURSES
from hysteresis_bench.study.results import PROVENANCE, PUBLISHED, RESPONSES, STUDY, SUMMARY, TRIALS, Results

SUCCESS = "A success is a trial whose fitness is within 1 % of the best known to the study on its instance."
DEFINITIONS = (
    ("Fitness", "The study's loss on the fitted records, as the study file names it; lower is better."),
    ("Relative RMS", "RMSE over the largest |output − offset| measured. In brackets the quartiles."),
    ("Largest error", "Largest |simulated − measured| over the same."),
    (
        "Instance",
        "The rig with its constants, drive and noise: the first as it stands, others drawn, the same for everybody. "
        "Where there are several, an instance is a block: medians and quartiles are over instances of the medians of "
        "their trials. Where there is one, its trials are the blocks, and what is found holds in it alone. "
        "Signals, stages and what the data determine are told of the first.",
    ),
    (
        "Success",
        f"{SUCCESS} The best known is that of all optimizers, whatever their budget. In brackets the 95 % Wilson "
        "interval, with as many trials as there are blocks.",
    ),
    (
        "ERT",
        "Expected running time: all evaluations spent, up to the success or to the end of the trial, for each success; "
        "its bootstrap interval is in summary.csv.",
    ),
    (
        "Failed trials",
        "They rank as infinitely bad in medians, quartiles and tests; two failures tie. A search that returned early "
        "is no failure: its result counts, and its evaluations are the ones it spent. An instance that cannot be "
        "simulated is a failure of every trial on it.",
    ),
    ("Deterministic", "All trials on an instance ended alike, to the last bit; one of them is counted."),
    (
        "Tests",
        "Friedman over all optimizers; then Wilcoxon signed-rank on logarithms, block by block (zero differences "
        "after Pratt, values within 10⁻⁶ of each other equal), corrected after Holm within a problem: against the "
        "reference over the others; against the best, which the same trials chose, over all pairs. Where the test "
        "favours one and A12 does not, we cannot tell. Fitness within 0.01 % of the best known counts as the best "
        "known; on data without noise, so does every fit with a relative "
        f"RMS below {EXACT:g}. Below {statistics.ENOUGH} blocks nothing is tested.",
    ),
    (
        "Equivalent",
        "The Bayesian signed-rank test of Benavoli and others (2017) gives a probability of at least 0.95 that two "
        "differ by less than 1 % of the relative RMS. This is asked first: a difference that is proved and too small "
        "to matter is none.",
    ),
    (
        "A12",
        "Vargha and Delaney: how often a trial of this optimizer is better than one of the other on the same instance, "
        "ties half. From 0.56 (0.44) a small effect, from 0.64 (0.36) medium, from 0.71 (0.29) large. In brackets the "
        "95 % interval, which knows that A12 ends at 0 and 1: Clopper and Pearson’s with an effective number of "
        "blocks, as Korn and Graubard (1998) have it. It is wide where one side always wins.",
    ),
)
FILES = {
    STUDY: "the study as it was run",
    TRIALS: "one row a trial",
    COURSES: "how every search went: counts of evaluations, each the steps since the last, and the best so far",
    CLAIMS: "the verdicts on the paper’s claims",
    TABLES: "the main tables for a paper, LaTeX",
    SUMMARY: "one row an optimizer and problem: every number of the tables",
    RESPONSES: "measured and simulated samples of the best trials",
    PROVENANCE: "versions, machine, settings",
    PUBLISHED: "the paper's tables, claims and audit",
}


def section(folder: Path, results: Results) -> Section:
    """folder : of the results, whose files are linked, as far as they are kept."""
    there = {name: what for name, what in FILES.items() if (folder / name).is_file()}
    if results.kept_small:  # computed for this page
        there.pop(RESPONSES, None)
    beside = files_beside(there)
    heading = "Definitions, and where every number comes from"
    return Section("definitions", heading, [Terms(DEFINITIONS), beside])
