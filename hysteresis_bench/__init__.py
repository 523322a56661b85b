"""Identify hysteresis models, settle which optimizer is worth using, find what the model lacks.

The Python interface that the commands call: load, fit, run_study, predict. Whatever is slow to import is
imported when it is first called.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hysteresis_bench.fit.fitting import Fit
    from hysteresis_bench.fit.model_file import FittedModel
    from hysteresis_bench.signals import Dataset
    from hysteresis_bench.study.results import Results

__all__ = ["fit", "load", "predict", "run_study"]


def load(*files: Path | str, held_out: Sequence[str] = (), skip: float | None = None) -> Dataset:
    """Data CSV files as one data set.

    held_out : names of records (a file's stem, with ":run" where there is a run column) that are not fitted
    skip : the first so many units of time of every record are simulated but not scored
    Raises UserError naming file, row and column.
    """
    from hysteresis_bench.data_files import read_data
    from hysteresis_bench.errors import UserError

    dataset = read_data([Path(file) for file in files])
    try:
        dataset = dataset.split(held_out)
    except ValueError as error:
        raise UserError("held out", f"{error}.") from None
    if not dataset.fitted:
        raise UserError("held out", "every record is held out; none is left to fit.")
    if skip is None:
        return dataset
    for record in dataset.records:
        if record.skip(skip).history > record.time.size - 2:
            raise UserError(record.name, f"skipping {skip:g} leaves nothing of a record that lasts {_lasts(record):g}.")
    return dataset.map(lambda record: record.skip(skip))


def _lasts(record: Any) -> float:
    return float(record.time[-1] - record.time[0])


def fit(dataset: Dataset, model: str, effects: Sequence[str] = (), **options: Any) -> Fit:
    """Fit a registered model to a data set; see hysteresis_bench.fitting.fit_records for the options."""
    from hysteresis_bench.fit.fitting import fit_records

    return fit_records(dataset, model, effects, **options)


def predict(model: FittedModel | Path | str, *files: Path | str) -> Dataset:
    """The records of data CSV files with their output replaced by a fitted model's prediction.

    model : a fitted model, or the path of its model.json
    """
    from hysteresis_bench.data_files import read_data
    from hysteresis_bench.fit.model_file import FittedModel, read_model

    fitted = model if isinstance(model, FittedModel) else read_model(Path(model))
    return fitted.predict(read_data([Path(file) for file in files], output_needed=False))


def run_study(path: Path | str, **options: Any) -> Results:
    """Run or continue a study and read its results; see hysteresis_bench.study.run.run_study for the options."""
    from hysteresis_bench.control.comparison import scores_on_rig
    from hysteresis_bench.study.results import read_results
    from hysteresis_bench.study.run import run_study as run
    from hysteresis_bench.study_diagnosis import close_the_loop

    return read_results(run(path, closed_loop=scores_on_rig, closing=close_the_loop, **options))
