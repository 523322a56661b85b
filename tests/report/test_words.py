"""The answer in plain words: who is best where there is noise, and who fits exactly where there is none."""

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.report.study.words import answer, exact, winners
from hysteresis_bench.report.trials.best_known import best_known
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.report.trials.summary import summary_of


def problem(errors, spent, trials=3):
    """One instance, every optimizer with the same relative RMS in all trials, reached after so many evaluations."""
    rows, traces = {}, {}
    for label, error in errors.items():
        columns = {"fitness": error**2, "relative_rms": error, "evaluations": 1000, "seconds": 1.0, "optimizer": label}
        columns |= {"rmse": error, "max_error": error, "held_out_rmse": np.nan, "status": "done", "instance": 1}
        rows[label] = pd.DataFrame({"trial": range(trials)}).assign(**columns)
        for trial in range(trials):
            traces[label, 1, trial] = np.array([1, spent[label]]), np.array([1.0, error**2])
    return Problem("known", list(errors), rows, traces, "pso, 50", best_known(pd.concat(rows.values())))


def said(here):
    summary = summary_of([here], 1000)
    [sentence] = winners([here], summary)
    return sentence, " ".join(answer([here], summary, []))


@pytest.fixture
def noiseless():
    return problem({"exact": 0.0, "nearly": 1e-9, "pso, 50": 1e-3}, {"exact": 400, "nearly": 40, "pso, 50": 900})


def test_of_exact_fits_nobody_is_the_better_one_and_the_first_is_named(noiseless):
    assert exact(noiseless) == ["nearly", "exact"]
    sentence, short = said(noiseless)
    assert (
        "2 optimizers fit exactly (relative RMS of at most 1×10⁻⁶); the first, nearly, after 40 evaluations."
        in sentence
    )
    assert "lower" not in sentence
    assert "nearly on “known” (exact, as is 1 other)" in short


def test_who_alone_fits_exactly_is_named():
    sentence, short = said(problem({"exact": 0.0, "pso, 50": 1e-3}, {"exact": 400, "pso, 50": 900}))
    assert "exact alone fits exactly" in sentence
    assert ", after 400 evaluations." in sentence
    assert "(exact)" in short


def test_with_noise_the_best_stands_beside_the_reference_whose_label_is_quoted():
    sentence, short = said(problem({"new": 1e-3, "pso, 50": 1e-2}, {"new": 400, "pso, 50": 900}))
    assert "new has the lowest median fitness" in sentence
    assert "100 times lower than the reference “pso, 50”)" in sentence
    assert "relative RMS 0.1\u202f%" in short
