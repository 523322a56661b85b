"""A family's finding reads as a sentence."""

from collections import namedtuple

import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.families import FamilyFinding


@pytest.mark.parametrize("name", ["lags-before", "lags-after"])
def test_a_finding_has_each_article_once(name):
    effect = registry.effect(name)()
    values = {p.name: 0.5 * (p.lower + p.upper) for p in effect.parameters}
    curve = effect.curve(namedtuple("Values", list(values))(**values))
    said = FamilyFinding(name, effect.family, curve).sentence
    assert said.startswith(f"{name} ({effect.family}): the ")
    assert "the the" not in said
