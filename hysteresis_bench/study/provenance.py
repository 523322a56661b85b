"""What a results folder says of its study: its text, versions, machine, data; and whether it is the same study."""

from __future__ import annotations

import hashlib
import json
import os
import platform
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hysteresis_bench import registry
from hysteresis_bench.errors import UserError
from hysteresis_bench.study.lock import LOCK, PART, write_whole
from hysteresis_bench.study.origin import plugins_of, processor, versions
from hysteresis_bench.study.results import PROVENANCE, PUBLISHED, STUDY
from hysteresis_bench.study.study_file import Study, read_study

OURS = (LOCK, PUBLISHED, PROVENANCE, STUDY)
"""What a run that was killed at its very beginning leaves."""


def describe(folder: Path, path: Path, *, study: Study, text: str, units: Mapping[str, Mapping[str, str]]) -> None:
    """Write into a results folder what the study is; raises UserError where the folder belongs to another one.

    path, text : of the study file;  units : of time, input and output, by the problem's name
    """
    provenance = _provenance(study, path) | {"units": units}
    if (folder / STUDY).is_file():
        before, _ = read_study(folder / STUDY)
        old = json.loads((folder / PROVENANCE).read_text(encoding="utf-8"))
        faults = differences(before, study, old, provenance)
        if faults:
            raise UserError(f"{folder} holds another study", [*faults, "Choose another folder with --out."])
        provenance["optimizers"] = {**old["optimizers"], **provenance["optimizers"]}
    elif any(file.name.removesuffix(PART) not in OURS for file in folder.iterdir()):
        raise UserError(str(folder), "is not empty and holds no study. Choose another folder with --out.")
    if study.published:
        source = path.parent / study.published
        if not source.is_file():
            raise UserError(str(path), f'published = "{study.published}": there is no such file beside the study.')
        write_whole(folder / PUBLISHED, source.read_text(encoding="utf-8"))
    write_whole(folder / PROVENANCE, json.dumps(provenance, indent=1) + "\n")
    write_whole(folder / STUDY, text)  # last: it makes the folder one of this study


def differences(before: Study, now: Study, old: Mapping[str, Any], new: Mapping[str, Any]) -> list[str]:
    """Why two studies are not the same one, a sentence each; old, new : their provenance"""
    was, is_now = before.identity(), now.identity()
    texts = ("title", "notes", "published")  # words about the study do not change its numbers
    faults = [
        f"{key} was {was[key]!r} there and is {is_now[key]!r} here."
        if key != "problem"
        else "its problems are not the same."
        for key in is_now
        if key not in texts and was[key] != is_now[key]
    ]
    for label, now_is in new["optimizers"].items():
        was_then = old["optimizers"].get(label, now_is)
        if any(was_then[key] != now_is[key] for key in ("plugin", "settings", "budget")):
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
            "version": plugin.version,
            "evaluations_per_iteration": built.evaluations_per_iteration(dimension),
        }
    files = [file for spec in study.problem for file in spec.data]
    return {
        "versions": dict(versions()),
        "machine": {"system": platform.platform(), "processor": processor(), "cores": os.cpu_count()},
        "plugins": [
            {"kind": plugin.kind, "name": plugin.name, "distribution": plugin.distribution, "version": plugin.version}
            for plugin in plugins_of(study)
        ],
        "optimizers": optimizers,
        "data": {file: hashlib.sha256((path.parent / file).read_bytes()).hexdigest() for file in files},
    }
