"""A file of a wanted output: what is wrong with it is told by row and column."""

import pytest

from hysteresis_bench.data.trajectory_file import read_trajectory
from hysteresis_bench.errors import UserError

UNITS = {"time": "s", "input": "V", "output": "um"}


def test_trajectories_with_faults_are_told_by_row(tmp_path):
    path = tmp_path / "wanted.csv"
    for text, words in (
        ("time [s],input [V]\n0,1\n1,2\n", 'no column "output"'),
        ("time,output\n0,1\n1,x\n", 'row 3, column "output"'),
        ("time,output\n0,1\n0,2\n", "must strictly increase"),
        ("time,output\n0,1\n", "at least 2"),
        ("", "is empty"),
    ):
        path.write_text(text)
        with pytest.raises(UserError, match=words):
            read_trajectory(path, UNITS)
