"""The report of a study: everything the page says, gathered from the results, and the page."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench import stats
from hysteresis_bench.registry import RANDOM_SEARCH
from hysteresis_bench.report.paper import beside, claims
from hysteresis_bench.report.paper.audit import Finding, audit
from hysteresis_bench.report.paper.by_record import by_record, measured_loops
from hysteresis_bench.report.paper.published import Published, check_published
from hysteresis_bench.report.shared.page import Cell, Table, listed, render, whole
from hysteresis_bench.report.shared.signal_figures import drive, errors, loop
from hysteresis_bench.report.shared.theme import Picture
from hysteresis_bench.report.study import tables, words
from hysteresis_bench.report.study.closing_section import closing_in_words, closing_view
from hysteresis_bench.report.study.determined import determined
from hysteresis_bench.report.study.figures import Look, all_trials, choose, convergence, runtime
from hysteresis_bench.report.study.parameters_by_iteration import parameters_by_iteration
from hysteresis_bench.report.study.stages_section import stage_views
from hysteresis_bench.report.study.summary import EXACT, Problem, at_iterations, other_budgets, problems, summarise
from hysteresis_bench.study.results import PROVENANCE, PUBLISHED, RESPONSES, STUDY, SUMMARY, TRIALS, Results

HEADINGS = (
    ("run", "What was run"),
    ("published", "Published beside ours"),
    ("claims", "Which of the paper’s claims hold here"),
    ("optimizers", "All optimizers at equal evaluations"),
    ("budgets", "At other budgets"),
    ("iterations", "At the paper’s number of iterations"),
    ("searches", "How the searches went"),
    ("signals", "Drive and response, loops, errors"),
    ("held-out", "Fitted and held-out error"),
    ("stages", "The linear section, and the whole model"),
    ("determined", "What the data determine"),
    ("audit", "Paper audit"),
    ("closing", "Closing the loop"),
    ("decisions", "What was left open, and decided"),
    ("definitions", "Definitions, and where every number comes from"),
)

SUCCESS = "A success is a trial whose fitness is within 1 % of the best known to the study on the problem."
DEFINITIONS = (
    ("Fitness", "The study's loss on the fitted records, as the study file names it; lower is better."),
    ("Relative RMS", "RMSE over the largest |output − offset| measured."),
    ("Largest error", "Largest |simulated − measured| over the same."),
    ("Success", f"{SUCCESS} In brackets the 95 % Wilson interval of the rate."),
    (
        "Evaluations to success",
        "Median over all trials of the evaluations after which the best fitness was within that 1 %; a trial that "
        "never got there counts as infinite, so “not reached” means that half of them did not.",
    ),
    (
        "ERT",
        "Expected running time: all evaluations spent, up to the success or to the end of the trial, for each success.",
    ),
    (
        "Failed trials",
        "They rank as infinitely bad in medians, quartiles and tests; two failures tie. A search that returned early "
        "is no failure: its result counts, and its evaluations are the ones it spent.",
    ),
    (
        "Tests",
        "Friedman over all optimizers with the trials as blocks; then Wilcoxon signed-rank on pairs of trials that "
        "share their first points (zero differences after Pratt), corrected after Holm within a problem. Fitness "
        "within 0.01 % of the best known counts as the best known; on data without noise, so does every fit with a "
        f"relative RMS below {EXACT:g}. Below "
        f"{stats.ENOUGH} trials no p-value is given.",
    ),
    (
        "A12",
        "Vargha and Delaney: how often a trial of this optimizer is better than one of the other, ties half. From 0.56 "
        "(0.44) a small effect, from 0.64 (0.36) medium, from 0.71 (0.29) large.",
    ),
)


def study_page(results: Results, summary: pd.DataFrame, folder: Path) -> str:
    """The whole page; its figures are written to the folder. summary : of summarise(results)"""
    published = check_published(results.published)
    here, everybody = problems(results), problems(results, any_budget=True)
    judged = claims.judge(published, everybody)
    findings = audit(published)
    reference = here[0].reference if here else results.study.reference
    looks = choose(here, reference, published.optimizers)
    budget = results.study.budget
    drawn = [(i, problem) for i, problem in enumerate(here, 1) if math.isfinite(problem.best_known)]
    count = published.iterations
    iterations = at_iterations(results, count) if count else pd.DataFrame()
    decisions = Table(
        "Decisions",
        ["Where", "Left open", "Decided"],
        [
            [decision.where, Cell(decision.open, "prose"), Cell(decision.decided, "prose")]
            for decision in published.decision
        ],
    )
    context: dict[str, Any] = {
        "title": results.study.title,
        "kicker": "hysteresis-bench study",
        "answer": words.answer(here, summary, judged)
        + ([closing_in_words(results.closing)] if results.closing else []),
        "run": words.run_in_words(results.trials, here),
        "failures": tables.failures(results),
        "facts": facts(results),
        "plugins": plugins(results),
        "published": published,
        "beside": [beside.results_beside(published, everybody), *beside.tables_beside(published, results, everybody)]
        if published.result or published.tables
        else [],
        "claims": tables.claims(judged) if judged else None,
        "level": stats.LEVEL,
        "reference": reference,
        "definition": SUCCESS,
        "optimizers": [tables.optimizers(problem, summary) for problem in here],
        "budgets": list(at_other_budgets(results)),
        "iterations": [tables.iterations(iterations, problem, count) for problem in here] if count else [],
        "held_out": [tables.held_out(problem, summary) for problem in here],
        "by_record": by_records(results, here, published),
        "movements": movements(results, here, published, folder),
        "chosen": chosen(looks, reference, published),
        "trials": [all_trials(folder, f"trials-{i}", problem, looks) for i, problem in drawn],
        "convergence": [convergence(folder, f"convergence-{i}", p, looks, budget) for i, p in drawn],
        "runtime": [runtime(folder, f"runtime-{i}", p, looks, budget) for i, p in drawn],
        **signals(results, here, published, looks, folder),
        "stages": stage_views(results, published, folder),
        "determined": determined(results, folder),
        "audit": tables.audit(findings) if findings else None,
        "audited": audited(findings),
        "closing": closing_view(results, folder),
        "decisions": decisions if published.decision else None,
        "notes": results.study.notes,
        "definitions": DEFINITIONS,
        "files": files(folder),
    }
    shown = {"published": "beside", "signals": "drives", "held-out": "held_out", "searches": "convergence"}
    context["contents"] = [
        (anchor, heading)
        for anchor, heading in HEADINGS
        if anchor in ("run", "definitions")
        or context[shown.get(anchor, anchor)]
        or (anchor == "decisions" and results.study.notes)
    ]
    return render("study.html.j2", **context)


def facts(results: Results) -> list[tuple[str, str]]:
    study, told = results.study, results.provenance
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
    machine = told.get("machine", {})
    found.append(("Machine", ", ".join(f"{key}: {value}" for key, value in machine.items()) or "not recorded"))
    versions = told.get("versions", {})
    found.append(("Versions", ", ".join(f"{name} {version}" for name, version in versions.items()) or "not recorded"))
    return found


def plugins(results: Results) -> Table:
    rows = []
    for label, told in results.provenance.get("optimizers", {}).items():
        settings = ", ".join(f"{key} = {value}" for key, value in told.get("settings", {}).items()) or "defaults"
        rows.append([label, told.get("plugin", ""), settings, told.get("summary", "")])
    return Table("Optimizers", ["Label", "Plugin", "Settings", "What it is"], rows)


def chosen(looks: Mapping[str, Look], reference: str, published: Published) -> str:
    papers = [label for label in published.optimizers if label in looks and label != reference]
    rest = [label for label in looks if label not in (reference, RANDOM_SEARCH, *papers)]
    parts = [f"the reference {reference}"] if reference in looks else []
    parts += [f"the paper's {listed(papers)}"] if papers else []
    parts += ["random search, the floor that everybody must beat"] if RANDOM_SEARCH in looks else []
    parts += (
        [f"the best of each problem by median fitness, in turn, as far as colours reach: {listed(rest)}"]
        if rest
        else []
    )
    return f"In colour: {'; '.join(parts)}. All the others are in the tables and in grey."


def audited(findings: list[Finding]) -> str:
    computed = [finding for finding in findings if finding.entry.arithmetic]
    wrong = [finding for finding in computed if finding.borne_out is False]
    verdict = "all of them are borne out" if not wrong else f"{len(wrong)} are not borne out"
    return f"{len(findings)} statements, {len(computed)} with arithmetic that was evaluated for this page: {verdict}."


def signals(
    results: Results, here: list[Problem], published: Published, looks: Mapping[str, Look], folder: Path
) -> dict[str, list[Picture]]:
    """Drive and response of every record once; loops and errors of the paper's optimizers and the best."""
    found: dict[str, list[Picture]] = {"drives": [], "loops": [], "errors": []}
    if results.responses.empty:
        return found
    drawn: list[pd.DataFrame] = []
    for i, problem in enumerate(here, 1):
        rows = results.responses[results.responses["problem"] == problem.name]
        units = results.provenance.get("units", {}).get(problem.name, {})
        labels = shown(problem, published, rows["optimizer"])
        before = len(drawn)
        records = dict(list(rows.groupby(["record", "role"], sort=False)))
        for j, ((record, role), part) in enumerate(records.items(), 1):
            one = part[part["optimizer"] == part["optimizer"].iloc[0]][["time", "input", "output"]]
            one = one.reset_index(drop=True)
            if not any(one.equals(other) for other in drawn):
                drawn.append(one)
                found["drives"].append(drive(folder, f"drive-{i}-{j}", one, units, f"{record} ({role})."))
            parts = {}
            for k, label in enumerate(labels, 1):
                mine = part[part["optimizer"] == label]
                colour = looks[label].colour
                parts[label] = (mine, colour)
                if role != "fitted" and label != problem.winner:
                    continue
                caption = f"{problem.name}, {record} ({role}): best trial of {label}."
                found["loops"].append(loop(folder, f"loop-{i}-{j}-{k}", mine, units, label, caption, colour))
            caption = f"{problem.name}, {record} ({role}): simulated minus measured."
            found["errors"].append(errors(folder, f"errors-{i}-{j}", parts, units, caption))
        if len(drawn) > before and (together := measured_loops(folder, f"measured-{i}", rows, units, problem.name)):
            found["drives"].append(together)
    return found


def shown(problem: Problem, published: Published, present: Iterable[str]) -> list[str]:
    """The paper's optimizers, the reference and the best of a problem, where they are present."""
    wanted = (*published.optimizers, problem.reference, problem.winner)
    return [label for label in dict.fromkeys(wanted) if label in set(present) and label in problem.labels]


def at_other_budgets(results: Results) -> Iterator[tuple[int, list[Table]]]:
    """(budget, a table a problem) of the optimizers that have another budget than the study's."""
    for budget in other_budgets(results):
        summary = summarise(results, budget)
        yield budget, [tables.optimizers(problem, summary) for problem in problems(results, budget)]


def by_records(results: Results, here: list[Problem], published: Published) -> list[Table]:
    if results.responses.empty:
        return []
    found = []
    for problem in here:
        rows = results.responses[results.responses["problem"] == problem.name]
        found.append(by_record(problem.name, rows, shown(problem, published, rows["optimizer"]), published))
    return [table for table in found if table]


def movements(results: Results, here: list[Problem], published: Published, folder: Path) -> list[Picture]:
    """The paper's own optimizers, all but the reference: how the parameters moved."""
    found = []
    for i, problem in enumerate(here, 1):
        for j, label in enumerate(each for each in published.optimizers if each != problem.reference):
            found.append(parameters_by_iteration(results, problem.name, label, folder, f"parameters-{i}-{j}"))
    return [drawn for drawn in found if drawn]


def files(folder: Path) -> list[tuple[str, str]]:
    known = {
        STUDY: "the study as it was run",
        TRIALS: "one row a trial",
        SUMMARY: "one row an optimizer and problem: every number of the tables",
        RESPONSES: "measured and simulated samples of the best trials",
        PROVENANCE: "versions, machine, settings",
        PUBLISHED: "the paper's tables, claims and audit",
    }
    return [(name, what) for name, what in known.items() if (folder / name).is_file()]
