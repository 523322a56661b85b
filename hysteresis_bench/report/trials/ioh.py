"""The searches of a study in the format of IOHprofiler, which IOHanalyzer and iohinspector read.

[1] J. de Nobel et al., "IOHexperimenter: benchmarking platform for iterative optimization heuristics", Evol. Comput. 32
(2024) 205: one JSON file an algorithm and function, beside it a table of evaluations and losses in which a run begins
at evaluation 1. A problem is a function, an instance keeps its number, a trial is a run; a failed trial has none.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from hysteresis_bench.errors import UserError
from hysteresis_bench.study.kept_files.trial_rows import KEY
from hysteresis_bench.study.results import Results

VERSION = "0.3.18"
"""Of IOHprofiler's format, which the files are written in."""
COLUMNS = ("evaluations", "raw_y")


def write_ioh(results: Results, folder: Path) -> list[Path]:
    """Write every search into the folder; returns the JSON files. Raises UserError where no search was kept."""
    if not results.traces:
        raise UserError(str(results.folder), "has no searches to export: their course was not kept (trials.sqlite).")
    written = []
    for number, spec in enumerate(results.study.problem, 1):
        for label in results.study.labels:
            keys = sorted(key for key in results.traces if key[:2] == (spec.name, label))
            if keys:
                written.append(_write(results, folder, number, keys))
    return written


def _write(results: Results, folder: Path, number: int, keys: list[tuple[str, str, int, int]]) -> Path:
    problem, label = keys[0][:2]
    rows = results.trials.set_index(list(KEY)).loc[keys]
    found = rows.filter(like="parameter.").dropna(axis="columns").astype(float)
    name = f"IOHprofiler_f{number}_{re.sub('[^A-Za-z0-9]+', '_', problem)}"
    dimension = found.shape[1]
    place = Path(re.sub("[^A-Za-z0-9]+", "_", label)) / f"data_f{number}"
    table = place / f"{name}_DIM{dimension}.dat"
    (folder / place).mkdir(parents=True, exist_ok=True)
    lines, runs = [" ".join(COLUMNS)], []
    for key in keys:
        trace, evaluations = results.traces[key], int(rows.loc[key, "evaluations"])
        improved = np.concatenate([[True], np.diff(np.minimum.accumulate(trace.losses)) < 0.0])
        pairs = zip(trace.evaluations[improved], trace.losses[improved], strict=True)
        lines += [f"{count} {loss:.10e}" for count, loss in pairs]
        best = {"evals": int(trace.evaluations[improved][-1]), "y": float(trace.losses[improved][-1])}
        point = {"x": [float(value) for value in found.loc[key]]}
        runs.append({"instance": key[2], "evals": evaluations, "best": best | point})
    (folder / table).write_text("\n".join(lines) + "\n", encoding="utf-8")
    content: dict[str, Any] = {
        "version": VERSION,
        "suite": results.study.title,
        "function_id": number,
        "function_name": problem,
        "maximization": False,
        "algorithm": {"name": label, "info": results.provenance.get("optimizers", {}).get(label, {}).get("plugin", "")},
        "attributes": list(COLUMNS),
        "scenarios": [{"dimension": dimension, "path": str(table.relative_to(place.parent)), "runs": runs}],
    }
    path = folder / place.parent / f"{name}.json"
    path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    return path
