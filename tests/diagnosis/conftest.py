"""What tests of diagnosis share."""

import pytest

from hysteresis_bench.diagnosis import diagnose
from hysteresis_bench.diagnosis.search import search

FEW = ("bouc-wen", "dahl", "energy-based", "ferroelectric", "prandtl-ishlinskii-modified")


@pytest.fixture(scope="module")
def few_laws():
    """Where the asked law does not follow, all others are asked what they need, which takes half a minute. These will
    do where a test is not about them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(diagnose, "_of_few_parameters", lambda laws: [law for law in laws if law in FEW])
        yield


@pytest.fixture(scope="module")
def no_free_forms():
    """A search among names only: free forms take most of its time where the law is wrong, and are then dropped."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(search, "with_free_forms", lambda selection, named: named)
        yield
