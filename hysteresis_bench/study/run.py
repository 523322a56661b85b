"""Run a study: trials into the store as they finish, then the tables. Run again, and it continues."""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import platform
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench import registry
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.search import seed_of
from hysteresis_bench.study.afterwards.best_fits import identifiability, responses
from hysteresis_bench.study.afterwards.stages import ClosedLoop, run_stages
from hysteresis_bench.study.pool import run_tickets
from hysteresis_bench.study.problems import build_problem, closing_dataset
from hysteresis_bench.study.results import IDENTIFIABILITY, PROVENANCE, PUBLISHED, RESPONSES, STAGES, STUDY, TRIALS
from hysteresis_bench.study.store import Outcome, Store
from hysteresis_bench.study.study_file import Study, check_study, read_study
from hysteresis_bench.study.trial import Ticket, run_trial, seed_key

LOCK = ".lock"
Closing = Callable[[Study, Path, Path], None]
"""(study, folder of its data, results folder): the diagnosis at the end; it comes from the floor above."""

PACKAGES = ("hysteresis-bench", "numpy", "scipy", "numba", "nlopt", "pymoo", "pandas", "matplotlib", "pebble")


@dataclass(frozen=True)
class Progress:
    """Told after every trial, and once before the first (outcome None)."""

    done: int
    total: int
    outcome: Outcome | None


def run_study(
    path: Path | str,
    trials: int | None = None,
    jobs: int | None = None,
    out: Path | str | None = None,
    tell: Callable[[Progress], None] = lambda progress: None,
    closed_loop: ClosedLoop | None = None,
    closing: Closing | None = None,
) -> Path:
    """Run every trial of a study that is not in its results folder yet; returns that folder.

    trials : overrides the file's number; jobs : worker processes, all cores by default;
    out : the results folder, see default_folder;  closed_loop : for studies with stages that ask for control
    closing : for studies with a table [closing]
    Raises UserError for a fault in the file, the data, or the folder.
    """
    path = Path(path)
    study, text = read_study(path)
    folder = Path(out) if out else default_folder(path)
    built = {spec.name: build_problem(spec, study.seed, path.parent) for spec in study.problem}
    if study.closing:
        closing_dataset(study, path.parent)  # its faults are told before the trials, not after them
    folder.mkdir(parents=True, exist_ok=True)
    with _alone(folder):
        units = {name: dict(one.dataset.units) for name, one in built.items()}
        _describe(folder, study, text, path, units)
        with Store(folder) as store:
            store.begin(study.title)
            _run_missing(store, study, path, trials or study.trials, jobs or os.cpu_count() or 1, tell)
            table, traces = store.table(), store.traces()
    table.to_csv(folder / TRIALS, index=False)
    staged, staged_responses = run_stages(study, table, built, path.parent, closed_loop)
    if study.stage:
        staged.to_csv(folder / STAGES, index=False)
    parts = [responses(table, built), staged_responses]
    pd.concat(parts).to_csv(folder / RESPONSES, index=False, float_format="%.7g")
    told = json.dumps(identifiability(study, table, traces, built), indent=1, allow_nan=False)
    (folder / IDENTIFIABILITY).write_text(told + "\n", encoding="utf-8")
    if study.closing and closing:
        with _alone(folder):
            closing(study, path.parent, folder)
    return folder


def default_folder(study: Path) -> Path:
    """results/NAME, in the project for a file in its studies folder, beside the file otherwise."""
    home = study.resolve().parent
    return (home.parent if home.name == "studies" else home) / "results" / study.stem


def _run_missing(
    store: Store, study: Study, path: Path, trials: int, jobs: int, tell: Callable[[Progress], None]
) -> None:
    text = study.model_dump_json()
    # trial by trial, so that a study that was stopped has as much of everything as can be
    everything = [
        Ticket(text, str(path.parent.resolve()), problem.name, label, trial)
        for trial in range(trials)
        for problem in study.problem
        for label in problem.optimizers or study.labels
    ]
    present = store.keys()
    missing = [ticket for ticket in everything if ticket.key not in present]
    done = len(everything) - len(missing)
    tell(Progress(done, len(everything), None))
    for ticket, outcome, status, reason in run_tickets(missing, run_trial, jobs, study.timeout):
        if outcome is None:
            seed = seed_of(*seed_key(study, ticket))[:16]
            outcome = Outcome(*ticket.key, seed=seed, status=status, reason=reason)
        store.add(outcome)
        done += 1
        tell(Progress(done, len(everything), outcome))


def _describe(folder: Path, study: Study, text: str, path: Path, units: dict[str, dict[str, str]]) -> None:
    """Write what the study is; raises UserError where the folder belongs to another one."""
    provenance = _provenance(study, path) | {"units": units}
    if (folder / STUDY).is_file():
        before = check_study(tomllib.loads((folder / STUDY).read_text(encoding="utf-8")), str(folder / STUDY))
        old = json.loads((folder / PROVENANCE).read_text(encoding="utf-8"))
        faults = _differences(before, study, old, provenance)
        if faults:
            raise UserError(f"{folder} holds another study", [*faults, "Choose another folder with --out."])
        provenance["optimizers"] = {**old["optimizers"], **provenance["optimizers"]}
    elif any(file.name != LOCK for file in folder.iterdir()):
        raise UserError(str(folder), "is not empty and holds no study. Choose another folder with --out.")
    if study.published:
        source = path.parent / study.published
        if not source.is_file():
            raise UserError(str(path), f'published = "{study.published}": there is no such file beside the study.')
        (folder / PUBLISHED).write_bytes(source.read_bytes())
    (folder / PROVENANCE).write_text(json.dumps(provenance, indent=1) + "\n", encoding="utf-8")
    (folder / STUDY).write_text(text, encoding="utf-8")


def _differences(before: Study, now: Study, old: dict[str, Any], new: dict[str, Any]) -> list[str]:
    was, is_now = before.identity(), now.identity()
    texts = ("title", "notes", "published")  # words about the study do not change its numbers
    faults = [
        f"{key} was {was[key]!r} there and is {is_now[key]!r} here."
        if key != "problem"
        else "its problems are not the same."
        for key in is_now
        if key not in texts and was[key] != is_now[key]
    ]
    for label, told in new["optimizers"].items():
        if label in old["optimizers"] and any(
            old["optimizers"][label][k] != told[k] for k in ("plugin", "settings", "budget")
        ):
            faults.append(f'optimizer "{label}" has other settings there; give this one another label.')
    faults += [f"{file} has changed since." for file, sha in new["data"].items() if old["data"].get(file, sha) != sha]
    return faults


def _provenance(study: Study, path: Path) -> dict[str, Any]:
    optimizers = {}
    dimension = len(registry.build("models", study.problem[0].model, study.problem[0].settings).parameters)
    for spec in study.optimizer:
        plugin = registry.load("optimizers", spec.plugin)
        built = registry.build("optimizers", spec.plugin, spec.settings)
        optimizers[spec.name] = {
            "plugin": spec.plugin,
            "settings": spec.settings,
            "budget": study.budget_of(spec),
            "summary": plugin.summary,
            "distribution": plugin.distribution,
            "evaluations_per_iteration": built.evaluations_per_iteration(dimension),
        }
    files = [file for spec in study.problem for file in spec.data]
    return {
        "versions": {"python": platform.python_version(), **{name: _version(name) for name in PACKAGES}},
        "machine": {"system": platform.platform(), "processor": _processor(), "cores": os.cpu_count()},
        "optimizers": optimizers,
        "data": {file: hashlib.sha256((path.parent / file).read_bytes()).hexdigest() for file in files},
    }


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown")


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """One writer a folder; the lock goes with the process, however it ends."""
    with (folder / LOCK).open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise UserError(str(folder), "another run is writing to this folder; wait for it.") from None
        yield
