"""A density that is as smooth as the data allow: found again from loops of several amplitudes, at one between them."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.fit.accuracy import accuracy
from hysteresis_bench.fit.smooth.smoothing import HEAVIEST, LIGHTEST, Smoothing
from hysteresis_bench.fit.unseen.whole import left_out
from hysteresis_bench.signals import Record
from hysteresis_plugins.models.energy_based import EnergyBased
from hysteresis_plugins.models.preisach_hats import PreisachHats

TRUTH = {"a": 0.8, "coupling": 0.2, "pinning": 0.6, "spread": 0.5, "reversible": 0.2, "slope": 0.05, "M_s": 1.5}


def loop(amplitude: float) -> Record:
    """Of another law, three cycles."""
    u = amplitude * np.sin(np.linspace(0.0, 6.0 * np.pi, 180))
    bare = Record(np.arange(u.size, dtype=float), u, None, name=str(amplitude))
    y = EnergyBased().simulate(bare.signal, SimpleNamespace(**{name: np.array([v]) for name, v in TRUTH.items()}))[:, 0]
    return Record(bare.time, u, y, name=bare.name)


def problem(records, **settings):
    return Stack(registry.build("models", "preisach-hats", settings), tuple(records)).problem({"record-offset"})


def test_another_laws_loop_between_the_fitted_amplitudes_is_predicted():
    records = [loop(amplitude) for amplitude in (1.0, 2.0, 3.0, 4.0)]
    asked = problem(records, plays=6, pieces=12)
    found = Smoothing(asked).searched(left_out(records))
    between = loop(2.5)
    assert accuracy(asked.system, [between], found.values).rmse < 0.01 * np.ptp(between.measured)
    assert LIGHTEST <= found.weight <= HEAVIEST
    assert found.freedom < asked.space.dimension
    np.testing.assert_allclose(Smoothing(asked).refitted(found), found.values, rtol=1e-6, atol=1e-9)


def test_an_even_density_has_no_roughness():
    law = PreisachHats(plays=3, pieces=4)
    p = SimpleNamespace(radius=np.array([2.0]), centre=np.array([0.1]), grading=np.array([1.3]))
    radii, nodes = (cells[:, 0] for cells in law.cells(p))
    widths = np.concatenate([[2.0 / 4.0], np.diff(np.append(radii, 2.0))[1:]])
    even = np.concatenate([[0.7], (widths[:, None] * np.diff(nodes)).ravel()])
    rough = law.roughness(p)
    np.testing.assert_allclose(rough @ even, 0.0, atol=1e-12)
    assert np.abs(rough @ np.arange(even.size)).max() > 0.1


def test_the_unit_of_the_input_changes_nothing():
    asked = [loop(amplitude) for amplitude in (2.0, 4.0)]
    scaled = [replace(record, input=1e5 * record.input) for record in asked]
    one, other = (
        Smoothing(problem(records, plays=3, pieces=6)).searched(left_out(records)) for records in (asked, scaled)
    )
    assert one.weight == pytest.approx(other.weight, abs=1e-6)
    np.testing.assert_allclose(one.left_out, other.left_out, atol=1e-6 * np.ptp(asked[1].measured))
