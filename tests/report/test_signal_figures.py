"""Loops of few cycles are drawn whole, of many cycles some."""

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.report.shared.signal_figures import loop, measured_loops

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
