"""Published numbers beside ours: results, what they imply, the search box, the identified parameters."""

from __future__ import annotations

from collections.abc import Iterator

from hysteresis_bench import statistics
from hysteresis_bench.report.paper.expression import evaluate
from hysteresis_bench.report.paper.published import Published
from hysteresis_bench.report.paper.published import Table as Printed
from hysteresis_bench.report.shared.blocks import Block, Cell, Paragraph, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import AS_PRINTED, NONE, number
from hysteresis_bench.report.trials.metrics import NAMES, metric_text
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.study.results import Results


def section(published: Published, results: Results, problems: list[Problem]) -> Section | None:
    """None where the paper prints no number."""
    if not (published.result or published.tables):
        return None
    beside = [_results_beside(published, problems), *_tables_beside(published, results, problems)]
    blocks: list[Block] = [published.because, *beside, Paragraph(published.citation, "source")]
    return Section("published", "Published beside ours", blocks)


def of_a_stage(table: Printed, results: Results) -> bool:
    """Does a printed table stand beside what followed a static problem, and so not among the others?"""
    fitted = any(set(spec.fit) <= set(table.columns) for spec in results.study.stage)
    controlled = any(spec.control for spec in results.study.stage)
    tracked = controlled and ("reference" in table.columns or "rho" in table.columns.get("parameter", []))
    return fitted or tracked or (bool(results.study.stage) and "record" in table.columns)


def _results_beside(published: Published, problems: list[Problem]) -> Table:
    """Every printed result, and what it implies, beside our best and median."""
    rows = list(_results(published, problems))
    header = ["Optimizer", "Quantity", "Published", "May be compared"]
    for problem in problems:
        header += [f"Ours, {problem.name}: best", "median"]
    return Table("Published results beside ours", header, rows)


def _results(published: Published, problems: list[Problem]) -> Iterator[list[str | Cell]]:
    for result in published.result:
        metric, may = result.metric, result.metric in published.comparable
        yield [
            result.optimizer,
            f"{NAMES.get(metric, metric)} ({result.where})",
            metric_text(metric, result.value),
            Cell("yes", "good") if may else Cell("no", "quiet"),
            *_ours(result.optimizer, metric, problems),
        ]
        for implied in (implied for implied in published.implied if implied.of == metric):
            for name, values in implied.given.items():
                for value in values:
                    follows = evaluate(implied.arithmetic, {**published.values, "value": result.value, name: value})
                    yield [
                        result.optimizer,
                        f"{NAMES.get(implied.metric, implied.metric)} implied if {name} = {_text(value)}",
                        metric_text(implied.metric, follows),
                        Cell("if so", "quiet"),
                        *_ours(result.optimizer, implied.metric, problems),
                    ]


def _ours(optimizer: str, metric: str, problems: list[Problem]) -> Iterator[str]:
    for problem in problems:
        if optimizer not in problem.labels or metric not in problem.rows[optimizer]:
            yield from (NONE, NONE)
            continue
        values = problem.values(optimizer, metric)
        yield metric_text(metric, statistics.quantile(values, 0.0))
        yield metric_text(metric, statistics.quantile(values, 0.5))


def _tables_beside(published: Published, results: Results, problems: list[Problem]) -> list[Table]:
    """Every printed table. One with the columns parameter, min and max is a search box and stands beside
    ours; one with the column optimizer holds identified values and stands beside our best trial's; one of a
    stage stands with the stage."""
    found = []
    for table in published.tables.values():
        columns = table.columns
        if of_a_stage(table, results):
            continue
        if {"parameter", "min", "max"} <= set(columns):
            found.append(_box(table.title, columns, results))
        elif "optimizer" in columns:
            found.append(_identified(table.title, columns, problems))
        else:
            rows = [[_text(value) for value in row] for row in zip(*columns.values(), strict=True)]
            found.append(Table(f"{table.title} (as printed)", list(columns), rows))
    return found


def _text(value: float | str) -> str:
    return value if isinstance(value, str) else number(value, AS_PRINTED)


def _box(title: str, columns: dict[str, list[float | str]], results: Results) -> Table:
    header = ["Parameter", "Published"]
    header += [
        f"Ours, {spec.name}{f' ({spec.scaling} scaling)' if spec.scaling else ''}" for spec in results.study.problem
    ]
    rows: list[list[str | Cell]] = []
    for name, low, high in zip(columns["parameter"], columns["min"], columns["max"], strict=True):
        row: list[str | Cell] = [str(name), f"{_text(low)} to {_text(high)}"]
        for spec in results.study.problem:
            if name in spec.bounds:
                row.append(" to ".join(map(_text, spec.bounds[str(name)])))
            elif name in spec.fixed:
                row.append(f"{_text(spec.fixed[str(name)])}, fixed")
            else:
                row.append("the data's" if spec.box == "data" else "the model's own")
        rows.append(row)
    return Table(title, header, rows)


def _identified(title: str, columns: dict[str, list[float | str]], problems: list[Problem]) -> Table:
    labels = [str(label) for label in columns["optimizer"]]
    quantities = [name for name in columns if name != "optimizer"]
    header, sides = ["Quantity"], []
    for position, label in enumerate(labels):
        header.append(f"{label}, published")
        sides.append({name: _text(columns[name][position]) for name in quantities})
        for problem in problems:
            if label in problem.labels:
                header.append(f"{label}, ours, {problem.name}")
                sides.append(_best_trial(problem, label, quantities))
    rows = [[name, *(side.get(name, NONE) for side in sides)] for name in quantities]
    return Table(f"{title}, beside the best of our trials", header, rows)


def _best_trial(problem: Problem, label: str, quantities: list[str]) -> dict[str, str]:
    best = problem.best_trial(label)
    if best is None:
        return {}
    values = {name: best.get(f"parameter.{name}", best.get(name)) for name in quantities}
    return {name: number(value) for name, value in values.items()}
