"""What tests of diagnosis share."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

import pytest

from hysteresis_bench.diagnosis import around, diagnose
from hysteresis_bench.diagnosis.search import search

FEW = ("bouc-wen", "dahl", "energy-based", "ferroelectric", "prandtl-ishlinskii-modified")


@pytest.fixture(scope="module")
def few_laws():
    """Where the asked law does not follow, all others are asked what they need, which takes half a minute. These will
    do where a test is not about them."""
    with pytest.MonkeyPatch.context() as patch:
        _ask_only(patch, FEW)
        yield


@pytest.fixture
def ask_only(monkeypatch):
    """Of all laws only these are asked about records that another one does not follow."""
    return partial(_ask_only, monkeypatch)


def _ask_only(patch, names):
    for module in (around, diagnose):
        patch.setattr(module, "of_few_parameters", lambda laws: [law for law in laws if law in names])


@contextmanager
def _names_only() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(search, "with_free_forms", lambda selection, found: selection.named(found))
        yield


@pytest.fixture(scope="session")
def names_only():
    """Within it, searches try no free form: four fifths of their time where the law is wrong, and dropped in the end
    (`test_a_wrong_law_is_told_and_nothing_is_named_in_its_place`)."""
    return _names_only
