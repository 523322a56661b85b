"""The columns of trials.csv, and what follows from them, as a page names and writes them."""

from __future__ import annotations

from hysteresis_bench.report.shared.text import number, percent, whole

TO_SUCCESS = "evaluations_to_success"
"""A metric that is no column: it is read from the traces."""

NAMES = {
    "fitness": "fitness",
    "relative_rms": "relative RMS",
    "max_error": "largest relative error",
    "rmse": "RMSE",
    "held_out_rmse": "held-out RMSE",
    "check_error": "mean largest error on the check",
    "check_rmse": "mean RMSE on the check",
}


def metric_text(metric: str, value: float) -> str:
    """A number of one metric; errors relative to the output in per cent."""
    if metric in ("relative_rms", "max_error"):
        return percent(value, 4)
    return whole(value) if metric == TO_SUCCESS else number(value)
