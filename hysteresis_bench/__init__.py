"""Identify hysteresis models, settle which optimizer is worth using, find what the model lacks.

The Python interface that the commands call. Whatever is slow to import is imported when it is first called.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hysteresis_bench.control.comparison import Comparison as ControlComparison
    from hysteresis_bench.data.layout import Layout as Layout
    from hysteresis_bench.diagnosis.findings.result import Diagnosis
    from hysteresis_bench.diagnosis.laws.comparison import Comparison
    from hysteresis_bench.diagnosis.question import DiagnosisOptions as DiagnosisOptions
    from hysteresis_bench.fit.fitting import Fit
    from hysteresis_bench.fit.fitting import FitOptions as FitOptions
    from hysteresis_bench.fit.model_file import FittedModel
    from hysteresis_bench.progress import OnStep
    from hysteresis_bench.signals import Dataset
    from hysteresis_bench.study.results import Results
    from hysteresis_bench.study.run import Progress
    from hysteresis_bench.study.run import RunOptions as RunOptions

__all__ = ["compare", "control", "diagnose", "fit", "load", "measure", "predict", "run_study"]

# Python binds a package's name when it is first imported: later than here, it would replace the function of that name.
for _package in ("control", "fit"):
    import_module(f"{__name__}.{_package}")


_OPTIONS = {
    "Layout": "data.layout",
    "FitOptions": "fit.fitting",
    "DiagnosisOptions": "diagnosis.question",
    "RunOptions": "study.run",
}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        """The options of the functions below, imported when they are first asked for."""
        if name in _OPTIONS:
            return getattr(import_module(f"{__name__}.{_OPTIONS[name]}"), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def load(*files: Path | str, held_out: Sequence[str] = (), layout: Layout | None = None) -> Dataset:
    """Data files as one data set, in the units of the first record that states them; `notes` tell of conversions.

    files : text, .xlsx, .mat, .npz or .h5 with the columns time, input, output, units in brackets
    layout : what the files do not say, such as Layout(input="Voltage", output="Displacement", rate=1000.0)
    held_out : names of records (a file's stem, with ":run" where there is a run column) that are not fitted
    Raises UserError naming file, row and column.
    """
    from hysteresis_bench.data.data_files import read_data
    from hysteresis_bench.data.layout import AS_THEY_SAY
    from hysteresis_bench.errors import UserError

    dataset = read_data([Path(file) for file in files], layout=layout or AS_THEY_SAY)
    try:
        dataset = dataset.split(held_out)
    except ValueError as error:
        raise UserError("held out", f"{error}.") from None
    if not dataset.fitted:
        raise UserError("held out", "every record is held out; none is left to fit.")
    return dataset


def measure(rig: str, *experiments: str, seed: int = 0, settings: Mapping[str, Any] | None = None) -> Dataset:
    """Data from a virtual rig: a record an experiment, each with units and noise of its own.

    rig, experiments : by name, see `hysteresis-bench list rigs`;  settings : of the rig
    seed : with the names of rig and experiment, what the noise depends on
    Raises UserError telling every unknown name.
    """
    from hysteresis_bench import registry
    from hysteresis_bench.errors import UserError, nearest
    from hysteresis_bench.study.problems import measure as measure_on

    faults = registry.faults("rigs", rig, settings or {})
    if faults:
        raise UserError("measure", faults)
    built = registry.build("rigs", rig, settings)
    unknown = [name for name in experiments if name not in built.experiments]
    if unknown or not experiments:
        known = [f'rig {rig} has no experiment "{name}". {nearest(name, built.experiments)}' for name in unknown]
        raise UserError("measure", known or [f"name an experiment. {nearest('', built.experiments)}"])
    return measure_on(built, experiments, seed, rig)


def fit(
    dataset: Dataset,
    model: str,
    effects: Sequence[str] = (),
    *,
    settings: Mapping[str, Any] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    fixed: Mapping[str, float] | None = None,
    options: FitOptions | None = None,
) -> Fit:
    """Fit a registered model, with effects around it, to the fitted records of a data set.

    effects : by name, innermost first;  settings : of the model
    bounds : (low, high) by parameter's name, in units; replaces parts of the box that follows from the data
    fixed : parameters that are known, by name, in units
    options : the search, its seed, and how the data are prepared, such as FitOptions(settle=True, seed=1)
    Raises UserError telling what is wrong with the names, the data, the box or the parameters.
    """
    from dataclasses import replace

    import numpy as np

    from hysteresis_bench.diagnosis.laws.following import cannot_follow
    from hysteresis_bench.fit.fitting import DEFAULT, fit_records
    from hysteresis_bench.fit.preparation import Preparation
    from hysteresis_bench.fit.unseen.interval import further

    given = options or DEFAULT
    found = fit_records(dataset, model, effects, settings=settings, bounds=bounds, fixed=fixed, options=given)
    seen = dataset.map(Preparation(given.input_offset, given.flip, given.skip)).fitted
    own = found.responses[found.responses["role"] == "fitted"]
    rmse = float(np.sqrt(np.mean((own["simulated"] - own["output"]) ** 2)))
    far = [clause for one in dataset.held_out if (clause := further(one, found.model.data["ranges"]["input"]))]
    extrapolated = (f"{clause}: its error tells of an extrapolation." for clause in far)
    return replace(found, warnings=(*found.warnings, *extrapolated, *cannot_follow(model, effects, seen, rmse)))


def diagnose(
    dataset: Dataset,
    model: str = "",
    effects: Sequence[str] = (),
    *,
    settings: Mapping[str, Any] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    fixed: Mapping[str, float] | None = None,
    options: DiagnosisOptions | None = None,
) -> Diagnosis:
    """Find what a registered model lacks on the fitted records; the held-out ones are opened once, at the end.

    model : where none is named, the law is found from the data, with its effects
    effects : known to act, around the model from the beginning;  settings, bounds, fixed : as of `fit`
    options : seed, processes, and how the data are prepared, such as DiagnosisOptions(settle=True, jobs=2)
    Raises UserError telling every fault at once.
    """
    from hysteresis_bench.diagnosis.diagnose import diagnose as diagnose_records
    from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question

    asked = (settings or {}, bounds or {}, fixed or {}, options or DiagnosisOptions())
    return diagnose_records(dataset, Question(model, effects, *asked))


def compare(
    dataset: Dataset,
    models: Sequence[str] = (),
    effects: Sequence[str] = (),
    *,
    options: DiagnosisOptions | None = None,
) -> Comparison:
    """Fit laws to the fitted records, and judge them by what they did not see, beside a polynomial without memory.

    models : by name, all registered ones where empty;  effects : known to act around every law
    options : seed, processes, and how the data are prepared
    Raises UserError telling every fault at once.
    """
    from dataclasses import replace

    from hysteresis_bench.diagnosis.laws.comparison import compare as compare_laws
    from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question

    asked = replace(options or DiagnosisOptions(), laws=tuple(models))
    return compare_laws(dataset, Question("", tuple(effects), options=asked))


def predict(model: FittedModel | Path | str, *files: Path | str, layout: Layout | None = None) -> Dataset:
    """The records of data files, in a fitted model's units, with their output replaced by its prediction.

    What prepared the fit is done again (a closed loop is repeated as often as there), and `notes` tell it.

    model : a fitted model, or the path of its model.json
    files : with the columns time and input; an output is not needed;  layout : as of `load`
    Raises UserError naming what is missing or wrong in the model's file, or file, row and column of the data.
    """
    from hysteresis_bench.data.data_files import read_data
    from hysteresis_bench.data.layout import AS_THEY_SAY
    from hysteresis_bench.fit.model_file import FittedModel, read_model

    fitted = model if isinstance(model, FittedModel) else read_model(Path(model))
    read = [Path(file) for file in files]
    return fitted.predict(read_data(read, output_needed=False, units=fitted.units, layout=layout or AS_THEY_SAY))


def control(
    model: FittedModel | Path | str,
    rig: str,
    *,
    rate: float | None = None,
    amplitude: float | None = None,
    seed: int = 0,
    on_step: OnStep | None = None,
) -> ControlComparison:
    """Every controller that a fitted model allows, along six references, on a virtual rig.

    model : a fitted model, or the path of its model.json;  rig : by name
    rate : samples a second, default 10000;  amplitude : of the references, in the output's unit, default 2
    seed : with the names of rig and reference, what the sensor's noise depends on
    on_step : called with where the comparison is
    Raises UserError where the rig cannot be run sample by sample, the model has no inverse, or its linear section is
    unstable or too fast for the rate.
    """
    from hysteresis_bench.control.comparison import compare, stepped_rig
    from hysteresis_bench.errors import UserError
    from hysteresis_bench.fit.model_file import FittedModel, read_model
    from hysteresis_bench.progress import quiet

    fitted = model if isinstance(model, FittedModel) else read_model(Path(model))
    given = {name: value for name, value in (("rate", rate), ("amplitude", amplitude)) if value is not None}
    try:
        built = stepped_rig(rig)
    except ValueError as error:
        raise UserError("control", str(error)) from None
    try:
        return compare(fitted, built, rig, seed=seed, on_step=on_step or quiet, **given)
    except ValueError as error:
        raise UserError("control" if fitted is model else str(model), str(error)) from None


def run_study(
    path: Path | str,
    *,
    trials: int | None = None,
    jobs: int | None = None,
    out: Path | str | None = None,
    options: RunOptions | None = None,
    on_progress: Callable[[Progress], None] = lambda progress: None,
) -> Results:
    """Run or continue a study, and the diagnosis at its end where it asks for one; then read its results.

    path : a study file (TOML);  trials : overrides the file's number;  jobs : worker processes, all cores by default
    out : the results folder; default: runs/NAME;  options : such as RunOptions(retry=True)
    on_progress : called after every trial, and once before the first
    Raises UserError telling every fault of the file, of the data, or of the folder.
    """
    from hysteresis_bench.study.results import read_results
    from hysteresis_bench.study_diagnosis import run_with_diagnosis

    folder = run_with_diagnosis(path, trials=trials, jobs=jobs, out=out, options=options, on_progress=on_progress)
    return read_results(folder)
