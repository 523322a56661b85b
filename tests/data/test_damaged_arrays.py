"""Files of arrays that are damaged: read, or refused in a sentence, and never the end of the process."""

import io
import os
import signal
import time
from contextlib import suppress

import numpy as np
import pytest
from scipy.io import savemat

from hysteresis_bench.data.data_files import read_data
from hysteresis_bench.data.readers import apart
from hysteresis_bench.data.readers.apart import read_apart
from hysteresis_bench.errors import UserError

TIME = np.arange(200) / 100.0
COLUMNS = {"time": TIME, "input": np.sin(9.0 * TIME), "output": np.cos(9.0 * TIME)}


@pytest.fixture(scope="module")
def whole():
    stored = io.BytesIO()
    savemat(stored, {**COLUMNS, "notes": {"a": TIME, "b": "bench"}})
    return stored.getvalue()


@pytest.mark.parametrize("seed", range(40))
def test_a_damaged_file_is_read_or_refused(seed, whole, tmp_path):
    rng, data = np.random.default_rng(seed), bytearray(whole)
    for place in rng.integers(0, 500, size=4):
        data[place] = rng.integers(0, 256)
    path = tmp_path / "bench.mat"
    path.write_bytes(bytes(data[: rng.integers(100, len(data))] if seed % 4 == 0 else data))
    with suppress(UserError):
        assert read_data([path]).records[0].time.size > 1


def test_a_reader_that_crashes_is_a_sentence(tmp_path):
    with pytest.raises(UserError, match="cannot be read as MATLAB data: it is damaged, and ends the reader"):
        read_apart(lambda: os.kill(os.getpid(), signal.SIGKILL), tmp_path / "a.mat", "MATLAB data")


def test_a_reader_that_never_ends_is_a_sentence(tmp_path, monkeypatch):
    monkeypatch.setattr(apart, "LONGEST_READ", 0.2)
    before = time.monotonic()
    with pytest.raises(UserError, match="does not come to an end"):
        read_apart(lambda: time.sleep(60.0), tmp_path / "a.h5", "HDF5")
    assert time.monotonic() - before < 20.0


def test_what_a_reader_raises_is_raised_here(tmp_path):
    def refuse():
        raise UserError("a.mat", ["no columns.", "and no rows."])

    with pytest.raises(UserError, match="2 faults") as refused:
        read_apart(refuse, tmp_path / "a.mat", "MATLAB data")
    assert refused.value.faults == ["no columns.", "and no rows."]
