"""Loops of few cycles are drawn whole, of many cycles some."""

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.report.shared.signal_figures import loop

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
