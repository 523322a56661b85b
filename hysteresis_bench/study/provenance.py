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
from hysteresis_bench.study.kept_files.json_forms import check_provenance
from hysteresis_bench.study.kept_files.reader import Reader
from hysteresis_bench.study.lock import LOCK, PART, write_whole
from hysteresis_bench.study.origin import plugins_of, processor, versions
from hysteresis_bench.study.problems import Built
from hysteresis_bench.study.results import PROVENANCE, PUBLISHED, STUDY
from hysteresis_bench.study.store import FILE
from hysteresis_bench.study.study_file import Study, read_study

OURS = (LOCK, PUBLISHED, PROVENANCE, STUDY)
"""What a run that was killed at its very beginning leaves."""
UNCHECKED = "whether data and settings are those of the earlier trials could not be checked"


def describe(folder: Path, path: Path, *, study: Study, text: str, built: Mapping[str, Built]) -> tuple[str, ...]:
    """Write into a results folder what the study is; returns what the user should know, a sentence each.

    path, text : of the study file;  built : its problems, by name
    Raises UserError where the folder belongs to another study.
    """
    now, notes = _provenance(study, path, built), _notes(study, path, built)
    reader = Reader(folder)
    old = reader.json(PROVENANCE, check_provenance)
    if (folder / STUDY).exists() or (old and (folder / FILE).exists()):
        if not old:
            notes.append(f"{PROVENANCE} could not be read and was written anew: {UNCHECKED}.")
        if faults := differences(_identity(folder, old, notes), study.identity(), old, now):
            raise UserError(f"{folder} holds another study", [*faults, "Choose another folder with --out."])
        now["optimizers"] = {**old.get("optimizers", {}), **now["optimizers"]}
        notes = list(dict.fromkeys([*notes, *(note for note in old.get("notes", ()) if UNCHECKED in note)]))
    elif any(file.name.removesuffix(PART) not in OURS for file in folder.iterdir()):
        raise UserError(str(folder), "is not empty and holds no study. Choose another folder with --out.")
    if study.published:
        write_whole(folder / PUBLISHED, _published(path, study.published))
    write_whole(folder / PROVENANCE, json.dumps(now | {"notes": notes}, indent=1) + "\n")
    write_whole(folder / STUDY, text)  # last: it makes the folder one of this study
    return tuple(notes)


def differences(
    was: Mapping[str, Any], is_now: Mapping[str, Any], old: Mapping[str, Any], new: Mapping[str, Any]
) -> list[str]:
    """Why two studies are not the same one, a sentence each; was, is_now : identities;  old, new : provenance"""
    texts = ("title", "notes", "published")  # words about the study do not change its numbers
    faults = [
        f"{key} was {was.get(key)!r} there and is {is_now[key]!r} here."
        if key != "problem"
        else "its problems are not the same."
        for key in is_now
        if key not in texts and was.get(key) != is_now[key]
    ]
    for label, now_is in new["optimizers"].items():
        was_then = old.get("optimizers", {}).get(label, now_is)
        if any(was_then[key] != now_is[key] for key in ("plugin", "settings", "budget")):
            faults.append(f'optimizer "{label}" has other settings there; give this one another label.')
    data = old.get("data", {})
    faults += [f"{file} has changed since." for file, sha in new["data"].items() if data.get(file, sha) != sha]
    return faults


def _identity(folder: Path, old: Mapping[str, Any], notes: list[str]) -> Mapping[str, Any]:
    """Of the study that a results folder holds; where its study.toml cannot be read, as its provenance keeps it."""
    try:
        return read_study(folder / STUDY)[0].identity()
    except UserError as error:
        kept = old.get("identity")
        if not isinstance(kept, dict):
            raise UserError(error.where, [*error.faults, "Choose another folder with --out."]) from None
        notes.append(f"{STUDY} of the results could not be read and was written anew, from the study file.")
        return kept


def _published(path: Path, name: str) -> str:
    """The text of the published file, which is copied into the results: it lies in the study's folder."""
    source = path.parent / name
    if not source.is_file():
        raise UserError(str(path), f'published = "{name}": there is no such file beside the study.')
    if _leaves(path, name):
        raise UserError(str(path), f'published = "{name}" is a link to {source.resolve()}; put the file itself there.')
    return source.read_text(encoding="utf-8")


def _notes(study: Study, path: Path, built: Mapping[str, Built]) -> list[str]:
    """What was done to the data, and which of them are not the study's own."""
    told = [note.removeprefix(f"{path.parent}/") for one in built.values() for note in one.dataset.notes]
    for file in _files(study):
        if _leaves(path, file):
            where = (path.parent / file).resolve()
            told.append(f'data "{file}" lie outside the study\'s folder: {where} is read, and is drawn in the results.')
    return list(dict.fromkeys(told))


def _leaves(path: Path, name: str) -> bool:
    """Whether a file that a study names is elsewhere than in the study's folder, links followed."""
    return not (path.parent / name).resolve().is_relative_to(path.parent.resolve())


def _files(study: Study) -> list[str]:
    return [file for spec in study.problem for file in spec.data]


def _provenance(study: Study, path: Path, built: Mapping[str, Built]) -> dict[str, Any]:
    optimizers = {}
    dimension = len(registry.build("models", study.problem[0].model, study.problem[0].settings).parameters)
    for spec in study.optimizer:
        plugin = registry.load("optimizers", spec.plugin)
        instance = registry.build("optimizers", spec.plugin, spec.settings)
        optimizers[spec.name] = {
            "plugin": spec.plugin,
            "settings": spec.settings,
            "budget": study.budget_of(spec),
            "summary": plugin.summary,
            "distribution": plugin.distribution,
            "version": plugin.version,
            "evaluations_per_iteration": instance.evaluations_per_iteration(dimension),
        }
    return {
        "identity": study.identity(),
        "versions": dict(versions()),
        "machine": {"system": platform.platform(), "processor": processor(), "cores": os.cpu_count()},
        "plugins": [
            {"kind": plugin.kind, "name": plugin.name, "distribution": plugin.distribution, "version": plugin.version}
            for plugin in plugins_of(study)
        ],
        "optimizers": optimizers,
        "data": {file: hashlib.sha256((path.parent / file).read_bytes()).hexdigest() for file in _files(study)},
        "units": {name: dict(one.dataset.units) for name, one in built.items()},
    }
