"""What a trial is made with: plugins and their distributions, package versions, the processor; do all agree?"""

from __future__ import annotations

import json
import platform
from collections import Counter
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING

from hysteresis_bench import registry

if TYPE_CHECKING:  # a fit has versions, too, and no study
    from hysteresis_bench.study.study_file import OptimizerSpec, ProblemSpec, Study

Trial = tuple[str, str, int, int]
"""problem, optimizer, instance, number"""
PACKAGES = ("hysteresis-bench", "numpy", "scipy", "numba", "nlopt", "pymoo", "pandas", "matplotlib")


def plugins_of(study: Study) -> list[registry.Plugin]:
    """Every plugin that a study names."""
    named: list[tuple[registry.Kind, str]] = [("optimizers", spec.plugin) for spec in study.optimizer]
    named += [("models", stage.model) for stage in study.stage]
    if study.closing:
        named += [("models", study.closing.model), *(("effects", name) for name in study.closing.effects)]
    return [*_loaded(named), *(plugin for problem in study.problem for plugin in plugins_of_problem(problem))]


def plugins_of_trial(problem: ProblemSpec, optimizer: OptimizerSpec) -> list[registry.Plugin]:
    """Every plugin that a trial runs."""
    return [*_loaded([("optimizers", optimizer.plugin)]), *plugins_of_problem(problem)]


def plugins_of_problem(problem: ProblemSpec) -> list[registry.Plugin]:
    """The model, the effects and the rig of a problem."""
    named: list[tuple[registry.Kind, str]] = [("models", problem.model), *(("effects", e) for e in problem.effects)]
    return _loaded([*named, ("rigs", problem.rig)] if problem.rig else named)


def _loaded(named: Sequence[tuple[registry.Kind, str]]) -> list[registry.Plugin]:
    """Effects that a model offers are its own: they are no plugins."""
    return [registry.load(kind, name) for kind, name in dict.fromkeys(named) if name in registry.names(kind)]


def origin(plugins: Sequence[registry.Plugin]) -> str:
    """What a trial in this process is made with: package versions, those of other distributions, the processor."""
    others = {plugin.distribution: plugin.version for plugin in plugins if not plugin.shipped}
    return json.dumps({"processor": processor(), **versions(), **others}, sort_keys=True)


def mixed(origins: Mapping[Trial, Mapping[str, str]]) -> tuple[str, ...]:
    """A sentence for each thing in which trials differ."""
    sentences = []
    for name in _differing(origins):
        counts = Counter(made_by[name] for made_by in origins.values() if name in made_by)
        parts = [f"{trials} with {its_version}" for its_version, trials in counts.items()]
        sentences.append(f"Trials were not all made with the same {name}: {', '.join(parts)}.")
    return tuple(sentences)


def made_with(origins: Mapping[Trial, Mapping[str, str]]) -> dict[str, list[Trial]]:
    """The trials by what they were made with, told in so far as they differ; empty where they do not."""
    names = _differing(origins)
    found: dict[str, list[Trial]] = {}
    for trial, all_of_it in origins.items() if names else ():
        words = ", ".join(f"{name} {all_of_it[name]}" for name in names if name in all_of_it)
        found.setdefault(words, []).append(trial)
    return found


def _differing(origins: Mapping[Trial, Mapping[str, str]]) -> list[str]:
    """Names of which trials have different versions; a distribution that a trial did not use is no difference."""
    versions_of: dict[str, set[str]] = {}
    for made_by in origins.values():
        for name, its_version in made_by.items():
            versions_of.setdefault(name, set()).add(str(its_version))
    return sorted(name for name, found in versions_of.items() if len(found) > 1)


@cache
def versions() -> Mapping[str, str]:
    """Of Python and of the packages that numbers may depend on."""
    return {"python": platform.python_version(), **{name: _version(name) for name in PACKAGES}}


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


@cache
def processor() -> str:
    """The processor's name, as the system gives it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown")
