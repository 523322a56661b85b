"""A given rate beside a column of time: what the column says is told, where it is another rate."""

import numpy as np
import pytest

from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.data.layout import Layout

COUNT = 100


def notes(folder, time, header="time [s]", rate=5.0):
    lines = [f"{when},{np.sin(k / 9):.6f},{np.cos(k / 9):.6f}" for k, when in enumerate(time)]
    path = folder / "bench.csv"
    path.write_text("\n".join([f"{header},input,output", *lines]), encoding="utf-8")
    dataset = read_data([path], layout=Layout(rate=rate))
    np.testing.assert_allclose(dataset.records[0].time, np.arange(COUNT) / rate)
    return " ".join(dataset.notes)


@pytest.mark.parametrize(
    ("time", "header"),
    [
        ([k / 100 for k in range(COUNT)], "time [s]"),
        ([10 * k for k in range(COUNT)], "time [ms]"),
        ([k % 50 / 100 for k in range(COUNT)], "t"),
        ([f"12:00:{k / 100:06.3f}" for k in range(COUNT)], "time"),
    ],
)
def test_another_rate_is_told(tmp_path, time, header):
    said = notes(tmp_path, time, header)
    assert "5 Hz as given in place of the column of time, which says 100 Hz" in said
    assert notes(tmp_path, time, header, rate=100.0) == ""


@pytest.mark.parametrize(
    ("time", "header"),
    [
        (range(COUNT), "time"),
        (range(COUNT), "time [sample]"),
        ([k // 5 for k in range(COUNT)], "time [s]"),
        ([0.0] * COUNT, "time [s]"),
        (["x"] * COUNT, "time"),
        (range(COUNT), "time [furlong]"),
    ],
)
def test_an_index_a_coarse_clock_and_what_is_no_time_say_nothing(tmp_path, time, header):
    assert notes(tmp_path, time, header) == ""
