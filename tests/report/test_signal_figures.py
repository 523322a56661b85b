"""Loops of few cycles are drawn whole, of many cycles some."""

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.report.shared.signal_figures import loop, measured_loops, within_a_line
from hysteresis_bench.report.shared.theme import legend, stroke

UNITS = {"time": "s", "input": "V", "output": "um"}


@pytest.mark.parametrize(
    ("cycles", "told"), [(5, "A record."), (20, "A record."), (200, "A record. 8 of 200 cycles are drawn.")]
)
def test_loops_that_would_cover_each_other_are_drawn_in_part(tmp_path, cycles, told):
    time = np.linspace(0.0, cycles, 60 * cycles)
    u = np.sin(2 * np.pi * time)
    rows = pd.DataFrame({"time": time, "input": u, "output": 2 * u, "simulated": 2 * u + 0.1, "optimizer": "pso"})
    drawn = loop(tmp_path, "loop", {"pso": (rows, "#123456")}, units=UNITS, caption="A record.")
    assert drawn.caption == told
    assert len((tmp_path / "figures" / "loop.svg").read_text()) < 60_000


def test_records_of_which_some_cycles_are_drawn_are_named(tmp_path):
    parts = []
    for name, cycles in (("sine", 5), ("sweep", 200)):
        u = np.sin(2 * np.pi * np.linspace(0.0, cycles, 60 * cycles))
        parts.append(pd.DataFrame({"record": name, "role": "fitted", "input": u, "output": 2 * u}))
    drawn = measured_loops(tmp_path, "measured", pd.concat(parts), units=UNITS, caption="All records.")
    assert drawn is not None
    assert drawn.caption == "All records. sweep: 8 of 200 cycles are drawn."


def test_curves_that_cover_each_other_are_named():
    curve = np.sin(np.linspace(0.0, 6.0, 100))
    curves = {"pso": curve, "ga, 50": curve + 0.001, "far": curve + 0.5, "short": curve[:50]}
    assert within_a_line(curves) == " Within a line’s width of each other: “pso” and “ga, 50”."
    assert within_a_line({"pso": curve, "far": curve + 0.5}) == ""
    assert within_a_line({"pso": curve}) == ""


def test_a_line_below_others_is_wider_and_no_two_neighbours_have_one_dash():
    drawn = [stroke(place, 4) for place in range(4)]
    widths = [each["linewidth"] for each in drawn]
    assert widths == sorted(widths, reverse=True)
    assert widths[-1] == 1.0
    assert len({str(each["linestyle"]) for each in drawn}) == 4
    assert stroke(0, 1) == {"linewidth": 1.0}


@pytest.mark.parametrize(("label", "columns"), [("ga", 3), ("best of all (pso, constant)", 2)])
def test_a_legend_has_as_many_columns_as_there_is_room_for(label, columns):
    from matplotlib.figure import Figure

    axes = Figure(figsize=(4.6, 3.6)).add_subplot()
    for name in ("measured", "gpmix", "pso", "ga", label):
        axes.plot([0, 1], label=name)
    legend(axes, 3)
    assert axes.get_legend()._ncols == columns
