"""How the constants of a study's rigs were chosen, and what differs between its instances."""

from __future__ import annotations

from hysteresis_bench import registry
from hysteresis_bench.report.shared.blocks import Block, Cell, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, number
from hysteresis_bench.study.instances import drawn_constants, ranges_of
from hysteresis_bench.study.results import Results
from hysteresis_bench.study.study_file import ProblemSpec


def section(results: Results) -> Section | None:
    """A table a rig and its settings; None without a rig."""
    blocks: list[Block] = []
    told = []
    for spec in results.study.problem:
        key = (spec.rig, spec.rig_settings, spec.ranges)
        if spec.rig is None or key in told or registry.faults("rigs", spec.rig, spec.rig_settings):
            continue
        told.append(key)
        here = results.trials[results.trials["problem"] == spec.name]["instance"]
        blocks.append(_table(spec, results.study.seed, sorted(map(int, here.unique()))))
    how = (
        "The first instance is the rig as it stands. In every other one these constants are drawn, each uniformly in "
        "its range, and the noise is another one; problems on the same rig and all optimizers share them."
    )
    return Section("instances", "The rig: which constants were chosen how", [how, *blocks]) if blocks else None


def _table(spec: ProblemSpec, seed: int, instances: list[int]) -> Table:
    assert spec.rig is not None
    stands = registry.build("rigs", spec.rig, spec.rig_settings)
    drawn = [drawn_constants(spec, seed, instance) for instance in instances if instance > 1]
    rows: list[list[str | Cell]] = [
        [
            name,
            number(getattr(stands, name)),
            _span([found.lower, found.upper]),
            _span([each[name] for each in drawn]) if drawn else NONE,
            Cell(found.why, "prose"),
        ]
        for name, found in ranges_of(spec).items()
    ]
    count = f"{len(instances)} instance{'s' * (len(instances) != 1)}"
    note = "" if rows else "The rig declares no range: its instances differ in noise alone."
    header = ["Constant", "As it stands", "Range", "Drawn", "Why"]
    return Table(f"{spec.name}: rig {spec.rig}, {count}", header, rows, note)


def _span(values: list[float]) -> str:
    return f"{number(min(values), 3)} to {number(max(values), 3)}"
