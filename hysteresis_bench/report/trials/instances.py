"""What differs between the instances of a study, and why so."""

from __future__ import annotations

from hysteresis_bench.report.shared.blocks import Block, Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import number
from hysteresis_bench.study.instances import drawn_constants, ranges_of
from hysteresis_bench.study.results import Results
from hysteresis_bench.study.study_file import ProblemSpec


def section(results: Results) -> Section | None:
    """Of every rig the constants that are drawn; None where there is one instance."""
    blocks: list[Block] = []
    for spec in results.study.problem:
        here = results.trials[results.trials["problem"] == spec.name]["instance"]
        if here.nunique() > 1:
            blocks.append(_table(spec, results.study.seed, sorted(here.unique())))
    if not blocks:
        return None
    how = (
        "The first instance is the rig as it stands. In every other one these constants are drawn, each uniformly in "
        "its range, and the noise is another one; problems on the same rig and all optimizers share them."
    )
    return Section("instances", "What differs between instances", [how, *blocks])


def _table(spec: ProblemSpec, seed: int, instances: list[int]) -> Table:
    drawn = [drawn_constants(spec, seed, instance) for instance in instances[1:]]
    rows: list[list[str | Cell]] = [
        [
            name,
            _span([found.lower, found.upper]),
            _span([each[name] for each in drawn]),
            Cell(found.why, "prose"),
        ]
        for name, found in ranges_of(spec).items()
    ]
    title = f"{spec.name}: rig {spec.rig}, {len(instances)} instances"
    note = "" if rows else "The rig declares no range: its instances differ in noise alone."
    return Table(title, ["Constant", "Range", "Drawn", "Why"], rows, note)


def _span(values: list[float]) -> str:
    return f"{number(min(values), 3)} to {number(max(values), 3)}"
