"""What was run: trials, failures, settings, machine."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from hysteresis_bench.report.shared.blocks import Block, Bullets, Details, Table, Terms
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import listed, whole
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.study.kept_files.trial_rows import FIRST
from hysteresis_bench.study.origin import made_with
from hysteresis_bench.study.results import Results


def section(results: Results, here: Sequence[Problem]) -> Section:
    """In words, with the trials that failed, and everything that was set."""
    failed, plugins = _failures(results), _plugins(results)
    blocks: list[Block] = [in_words(results.trials, here), *([failed] if failed else [])]
    if notes := results.provenance.get("notes"):
        blocks.append(Bullets(notes))
    if results.mixed:
        blocks += [Bullets(results.mixed), Details("Which trials were made with what", [_origins(results)])]
    blocks.append(Terms(_facts(results)))
    blocks.append(Details(f"The {len(plugins.rows)} optimizers and their settings", [plugins]))
    return Section("run", "What was run", blocks)


def in_words(trials: pd.DataFrame, problems: Sequence[Problem]) -> str:
    """How many trials of what, and how many failed."""
    failed = int(trials["fitness"].isna().sum())
    labels = {label for problem in problems for label in problem.labels}
    least = min(problems, key=lambda problem: problem.blocks).counted if problems else "0 trials"
    fate = "none failed" if failed == 0 else f"{failed} failed and rank as infinitely bad"
    return (
        f"{len(trials)} trials: {len(labels)} optimizers on {len(problems)} problem{'s' * (len(problems) != 1)}, "
        f"{least} that all of them have; {fate}."
    )


def _failures(results: Results) -> Table | None:
    """Trials that failed or ended early, counted by reason; None without any."""
    other = results.trials[results.trials["status"] != "done"]
    if other.empty:
        return None
    keys = ["problem", "optimizer", *(["instance"] if results.trials["instance"].nunique() > 1 else [])]
    keys += ["status", "reason"]
    counted = other.assign(reason=other["reason"].fillna("")).value_counts(keys, sort=False).reset_index()
    rows = [[str(value) for value in row] for row in counted.to_numpy()]
    return Table("Trials that failed or ended early", [*(key.capitalize() for key in keys), "Trials"], rows)


def _origins(results: Results) -> Table:
    rows = []
    for words, trials in made_with(results.origins).items():
        numbers: dict[tuple[str, str], list[int]] = {}
        for problem, optimizer, instance, number in sorted(trials):
            name = optimizer if instance == FIRST else f"{optimizer}, instance {instance}"
            numbers.setdefault((problem, name), []).append(number)
        rows += [[words, *pair, ", ".join(map(str, found))] for pair, found in numbers.items()]
    return Table(
        "What the trials were made with, as far as it differs", ["Made with", "Problem", "Optimizer", "Trials"], rows
    )


def _facts(results: Results) -> list[tuple[str, str]]:
    study, made = results.study, results.provenance
    budgets = sorted({study.budget_of(spec) for spec in study.optimizer})
    found = [
        ("Seed", str(study.seed)),
        ("Budget", f"{' or '.join(whole(budget) for budget in budgets)} evaluations a trial"),
        ("Time limit", f"{study.timeout:g} s a trial"),
    ]
    for spec in study.problem:
        source = f"rig {spec.rig}" if spec.rig else f"data {listed(spec.data)}"
        effects = f" with {listed(spec.effects)}" if spec.effects else ""
        scaling = f"; {spec.scaling} scaling" if spec.scaling else ""
        held = f", held out {listed(spec.held_out)}" if spec.held_out else ""
        fitted = listed(spec.fitted) if spec.fitted else "all other records"
        text = f"{spec.model}{effects} on {source}: fitted {fitted}{held}{scaling}; loss {spec.loss}"
        found.append((f"Problem “{spec.name}”", text))
    machine = made.get("machine", {})
    found.append(("Machine", ", ".join(f"{key}: {value}" for key, value in machine.items()) or "not recorded"))
    versions = made.get("versions", {})
    found.append(("Versions", ", ".join(f"{name} {version}" for name, version in versions.items()) or "not recorded"))
    return found


def _plugins(results: Results) -> Table:
    rows = []
    for label, made in results.provenance.get("optimizers", {}).items():
        settings = ", ".join(f"{key} = {value}" for key, value in made.get("settings", {}).items()) or "defaults"
        rows.append([label, made.get("plugin", ""), settings, made.get("summary", "")])
    return Table("Optimizers", ["Label", "Plugin", "Settings", "What it is"], rows)
