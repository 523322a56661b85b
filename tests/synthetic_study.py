"""A results folder made of seeded random numbers, as the study layer would write it, for tests of the report."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd

from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.study.results import IDENTIFIABILITY, PROVENANCE, PUBLISHED, RESPONSES, STUDY, TRIALS
from hysteresis_bench.study.store import Outcome, Store

STUDIES = Path(__file__).parents[1] / "studies"
PROBLEMS = ("paper box, linear", "paper box, log")
BUDGET = 15050

# label: plugin, how far above the floor its trials end (median factor), spread, evaluations an iteration
OPTIMIZERS = {
    "pso": ("pso", 1.60, 0.30, 50),
    "mpso": ("mpso", 1.12, 0.12, 50),
    "random-search": ("random-search", 3.00, 0.20, None),
    "pso-constriction": ("pso-constriction", 1.004, 0.01, 50),
    "scipy-differential-evolution": ("scipy-differential-evolution", 1.004, 0.01, 75),
    "nlopt-crs2": ("nlopt-crs2", 1.02, 0.05, None),
    "scipy-least-squares": ("scipy-least-squares", 1.0, 0.0, None),
    "pymoo-ga": ("pymoo-ga", 1.8, 0.4, 50),
}


def write_results(
    folder: Path, trials: int = 20, published: bool = True, fail: bool = True, budget: int = BUDGET
) -> Path:
    """Write a finished study into a folder, without report, and return the folder."""
    rng = np.random.default_rng(5)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / STUDY).write_text(study_text(trials, published, budget), encoding="utf-8")
    if published:
        (folder / PUBLISHED).write_bytes((STUDIES / "sma.published.toml").read_bytes())
    (folder / PROVENANCE).write_text(json.dumps(provenance(budget)), encoding="utf-8")
    (folder / IDENTIFIABILITY).write_text(json.dumps(identifiability()), encoding="utf-8")
    with Store(folder) as store:
        store.begin("Synthetic")
        for problem in PROBLEMS:
            for label, (_, factor, spread, _) in OPTIMIZERS.items():
                for trial in range(trials):
                    failed = fail and label == "pymoo-ga" and trial % 3 == 0
                    store.add(outcome(problem, label, trial, factor, spread, failed, rng, budget))
        store.table().to_csv(folder / TRIALS, index=False)
    responses(rng).to_csv(folder / RESPONSES, index=False)
    return folder


def outcome(problem, label, trial, factor, spread, failed, rng, budget) -> Outcome:
    if failed:
        return Outcome(problem, label, trial, "0", "timed-out", "stopped after 600 s")
    floor = 2e-3 if "log" in problem else 5e-3
    final = floor * (1.0 + (factor - 1.0) * np.exp(rng.normal(0, 0.4)) + spread * rng.random())
    counts = np.unique(np.concatenate([[1], np.sort(rng.integers(2, budget, 40))]))
    losses = final * (1.0 + 200.0 * np.exp(-4.0 * np.log(counts) / np.log(budget) * 2) * np.linspace(1, 0, counts.size))
    losses = np.minimum.accumulate(losses) * np.linspace(1 + 1e-9, 1, counts.size)
    values = {"alpha": 10 ** rng.uniform(-14, -4), "a": rng.uniform(5, 15), "k": rng.uniform(10, 60),
              "M_s": rng.uniform(2e7, 3e7), "c": rng.uniform(0, 1)}  # fmt: skip
    points = np.tile(list(values.values()), (counts.size, 1))
    return Outcome(
        problem, label, trial, "0", "done", "", budget, float(losses[-1]), 30 * float(losses[-1]),
        30 * float(losses[-1]) / 28, 90 * float(losses[-1]) / 28, 34 * float(losses[-1]), 0.2 + 0.1 * rng.random(),
        values, Trace(counts, losses, points),
    )  # fmt: skip


def responses(rng) -> pd.DataFrame:
    parts = []
    for record, role, period in (("pwm-60s", "fitted", 60.0), ("pwm-50s", "held-out", 50.0)):
        time = np.arange(0, 2 * period, 0.1)
        temperature = 30 - 28 * np.cos(2 * np.pi * time / period)
        rising = np.gradient(temperature) > 0
        angle = 14 * (1 + np.tanh((temperature - np.where(rising, 38, 26)) / 7)) + rng.normal(0, 0.05, time.size)
        for problem in PROBLEMS:
            for label, (_, factor, _, _) in OPTIMIZERS.items():
                simulated = 14 * (1 + np.tanh((temperature - np.where(rising, 36, 28)) / (9 * factor)))
                parts.append(pd.DataFrame({
                    "problem": problem, "optimizer": label, "record": record, "role": role, "time": time,
                    "input": temperature, "output": angle, "simulated": simulated}))  # fmt: skip
    return pd.concat(parts)


def study_text(trials: int, published: bool, budget: int) -> str:
    lines = ['title = "Which optimizer finds the actuator\'s loop?"', "seed = 20190801", f"trials = {trials}"]
    lines += [f"budget = {budget}", 'notes = ["Every number here is random: <b>a test</b>."]']
    lines += ['published = "sma.published.toml"'] if published else []
    for name in PROBLEMS:
        scaling = "log" if "log" in name else "linear"
        lines += ["[[problem]]", f'name = "{name}"', 'model = "polynomial"', 'data = ["a.csv"]']
        lines += [f'scaling = "{scaling}"', 'held_out = ["pwm-50s"]', "bounds = { a = [0.01, 1e4] }"]
    for label, (plugin, _, _, _) in OPTIMIZERS.items():
        lines += ["[[optimizer]]", f'plugin = "{plugin}"', f'label = "{label}"']
    return "\n".join(lines) + "\n"


def provenance(budget: int) -> dict:
    units = {"time": "s", "input": "°C", "output": "°"}
    return {
        "versions": {"python": "3.11", "hysteresis-bench": "0.1.0"},
        "machine": {"system": "Linux", "processor": "a test", "cores": 2},
        "units": {problem: units for problem in PROBLEMS},
        "optimizers": {
            label: {"plugin": plugin, "settings": {}, "budget": budget, "summary": f"What {plugin} is.",
                    "evaluations_per_iteration": cost}
            for label, (plugin, _, _, cost) in OPTIMIZERS.items()
        },
    }  # fmt: skip


def identifiability() -> dict:
    names, grid = ["alpha", "a", "k", "M_s", "c"], np.linspace(5, 15, 13)
    analysis = {
        "names": names, "units": ["1", "°C", "°C", "A/m", "1"], "values": [1e-9, 10.0, 30.0, 2.5e7, 0.5],
        "standard_errors": [None, 0.1, 0.4, 3e7, 0.01], "rank": 4, "determined": 3,
        "singular_values": [9, 5, 3, 1, 0],
        "effective_samples": 40.0, "sentences": ["alpha cannot be told from these records."],
        "profiles": [{"name": "a", "grid": grid.tolist(), "ratio": (4.0 * (grid - 10) ** 2).tolist()}],
    }  # fmt: skip
    return {PROBLEMS[0]: analysis, PROBLEMS[1]: {"fault": "there are more parameters than samples"}}
