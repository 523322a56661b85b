"""Arrays read at once against np.load: the same arrays, and the same errors for what is damaged."""

import io

import numpy as np
import pytest

from hysteresis_bench.study.kept_files import packed
from hysteresis_bench.study.kept_files.packed import unpacked

RNG = np.random.default_rng(5)


def blob(save=np.savez, **arrays) -> bytes:
    buffer = io.BytesIO()
    save(buffer, **arrays)
    return buffer.getvalue()


def trace(improvements=4, dimension=3) -> dict:
    counts = np.cumsum(RNG.integers(1, 9, improvements))
    return {
        "evaluations": counts,
        "losses": np.sort(RNG.random(improvements))[::-1].copy(),
        "points": RNG.random((improvements, dimension)),
    }


def loaded(read, content):
    """What it gives, or the kind of what it raises."""
    try:
        found = read(content)
    except Exception as error:
        return type(error)
    return {name: (each.dtype, each.shape, each.flags.c_contiguous, each.tobytes()) for name, each in found.items()}


def by_numpy(content):
    with np.load(io.BytesIO(content)) as arrays:
        return {name: arrays[name] for name in arrays.files}


@pytest.mark.parametrize(
    "arrays",
    [
        trace(), trace(0), trace(300, 1), {}, {"a": np.float64(3.0)}, {"a": np.asfortranarray(RNG.random((3, 4)))},
        {"a": np.arange(3, dtype=">i2")}, {"a": np.array(["x", "yz"])}, {"a": np.array([True, False])},
    ],
)  # fmt: skip
@pytest.mark.parametrize("save", [np.savez, np.savez_compressed])
def test_arrays_are_those_that_were_packed(arrays, save):
    content = blob(save, **arrays)
    assert loaded(unpacked, content) == loaded(by_numpy, content)


def test_a_trace_is_read_without_an_archive_and_can_be_written_to(monkeypatch):
    monkeypatch.setattr(packed.np, "load", None)
    for each in unpacked(blob(**trace())).values():
        assert each.flags.owndata
        assert each.flags.writeable
        assert each.flags.aligned


def test_damage_is_told_as_numpy_tells_it():
    whole = blob(**trace())
    for place in range(len(whole)):
        flipped = whole[:place] + bytes([255 - whole[place]]) + whole[place + 1 :]
        assert loaded(unpacked, flipped) == loaded(by_numpy, flipped), place
    for end in range(0, len(whole), 7):
        assert loaded(unpacked, whole[:end]) == loaded(by_numpy, whole[:end]), end
    assert loaded(unpacked, b"PK" + whole) == loaded(by_numpy, b"PK" + whole)
