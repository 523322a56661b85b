"""Laws of play operators on data of known truth."""

from dataclasses import replace

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.fit.fitting import FitOptions, fit_records
from hysteresis_bench.fit.model_file import read_model, write_model
from hysteresis_bench.signals import Dataset, Record
from hysteresis_plugins.models._data import sense
from hysteresis_plugins.models.prandtl_ishlinskii import PrandtlIshlinskii
from hysteresis_plugins.models.prandtl_ishlinskii_modified import PrandtlIshlinskiiModified
from hysteresis_plugins.models.preisach import Preisach
from hysteresis_plugins.models.preisach_hats import PreisachHats
from tests.plugins.truths import TIME, held, record, simulated, solved, waves

WEIGHTS = {"w1": 0.8, "w2": 0.3, "w3": 0.1}


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_weights_of_either_sense_are_found_again_inside_the_box(side):
    law = PrandtlIshlinskii(plays=3)
    truth = {"radius": 0.9, "slope": 1.6, **{name: side * w for name, w in WEIGHTS.items()}}
    one = record(law, waves(), **truth)
    found = solved(law, one, radius=0.9)
    np.testing.assert_allclose([found[name] for name in law.linear], [truth[name] for name in law.linear], rtol=1e-8)
    assert not held(law, [one], truth)
    box = {q.name: q for q in law.box([one])}
    assert (box["w1"].lower, box["w1"].upper)[side > 0] != 0.0 == (box["w1"].lower, box["w1"].upper)[side < 0]


def test_no_threshold_lies_where_the_input_never_was():
    for law in (PrandtlIshlinskii(), PrandtlIshlinskiiModified(), Preisach()):
        radius = law.box([Record(TIME, waves(2.0, centre=5.0), waves())])[0]
        assert radius.upper <= 2.0


def test_either_sense_is_allowed_where_the_data_do_not_say():
    box = PrandtlIshlinskii().box([Record(TIME, waves(), 2.0 * waves())])
    assert box[2].lower == -box[2].upper < 0.0


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_reversal_curves_tell_the_sense_together(side, way):
    law = PrandtlIshlinskii(plays=3)
    truth = {"radius": 0.9, "slope": 1.6, **{name: side * w for name, w in WEIGHTS.items()}}
    records = []
    for back in (-0.6, -0.2, 0.2, 0.6):
        u = way * np.concatenate([[-1.0, 1.0], np.linspace(back, 1.0, 40)])
        y = simulated(law, u, time=np.arange(42.0), **truth)
        records.append(Record(np.arange(42.0), u, y, history=2))
    assert sense(records) == side
    assert sense(records[:1]) == 0
    assert sense([replace(one, history=0) for one in records]) == 0  # the way back is one step


def test_coefficients_of_polynomials_are_found_again_inside_the_box():
    law = Preisach(plays=2, degree=3)
    rng = np.random.default_rng(3)
    truth = {"radius": 0.9, **{name: rng.normal() for name in law.linear}}
    one = record(law, waves(centre=1.0), **truth)
    found = solved(law, one, radius=0.9)
    np.testing.assert_allclose([found[name] for name in law.linear], [truth[name] for name in law.linear], rtol=1e-5)
    assert not held(law, [one], truth)


def test_straight_curves_make_preisach_a_prandtl_ishlinskii():
    u = waves()
    straight = simulated(Preisach(plays=3, degree=1), u, radius=0.8, a0_1=1.6, a1_1=0.8, a2_1=0.3, a3_1=0.1)
    assert np.array_equal(straight, simulated(PrandtlIshlinskii(plays=3), u, radius=0.8, slope=1.6, **WEIGHTS))


def test_dead_zones_make_a_loop_without_symmetry():
    law = PrandtlIshlinskiiModified(plays=2, zones=1)
    values = {"radius": 0.6, "w1": 1.0, "w2": 0.5, "centre": 0.1, "reach": 0.8, "slope": 2.0}
    even = simulated(law, waves(), **values, above1=0.0, below1=0.0)
    odd = simulated(law, waves(), **values, above1=-1.0, below1=0.0)
    assert even.max() == pytest.approx(-even.min(), rel=0.1)
    assert odd.max() < 0.85 * even.max()
    assert np.array_equal(odd < 0.0, even < 0.0)
    one = Record(TIME, waves(), odd)
    found = solved(law, one, **{name: values[name] for name in ("radius", "w1", "w2", "centre", "reach")})
    np.testing.assert_allclose([found[name] for name in law.linear], [2.0, -1.0, 0.0], atol=1e-9)


@pytest.mark.parametrize("settings", [{"plays": 0}, {"plays": 100}, {"plays": True}])
def test_a_number_of_plays_out_of_reason_is_a_fault(settings):
    assert registry.faults("models", "prandtl-ishlinskii", settings)


def test_settings_carry_the_parameters():
    assert len(PrandtlIshlinskii(plays=4).parameters) == 6
    assert len(Preisach(plays=4, degree=2).parameters) == len(Preisach(plays=4, degree=2).linear) + 1 == 11
    assert len(PrandtlIshlinskii().parameters) == len(PrandtlIshlinskii.parameters) == 14


def test_thresholds_grow_with_the_frequency():
    law = registry.build("models", "prandtl-ishlinskii", {"plays": 1})
    from hysteresis_bench.compose import System

    system = System(law, registry.build_effects(law, ["threshold-rate"]))
    u = waves()
    fast = Record(TIME / 10.0, u, None)
    values = np.array([[0.9], [0.0], [1.0], [0.1]])
    grown = system.simulate(fast.signal, values)[:, 0]
    path, span = np.sum(np.abs(np.diff(u))), np.ptp(u)
    radius = 0.45 * (1.0 + 0.1 * np.log(path / (2.0 * span * 0.6)))
    assert np.array_equal(grown, simulated(law, u, radius=2.0 * radius, slope=0.0, w1=1.0))


def test_a_density_is_read_off_reversal_curves():
    law = PreisachHats(plays=2, pieces=3)
    rng = np.random.default_rng(5)
    truth = {"radius": 0.9, "centre": 0.1, "grading": 1.0, **{name: rng.random() for name in law.linear}}
    one = record(law, waves(1.6, centre=0.1), **truth)
    found = solved(law, one, **{name: truth[name] for name in ("radius", "centre", "grading")})
    np.testing.assert_allclose([found[name] for name in law.linear], [truth[name] for name in law.linear], rtol=1e-6)
    assert not held(law, [one], truth)


def test_a_fitted_law_keeps_its_settings_and_its_radius(tmp_path):
    law = PrandtlIshlinskii(plays=2)
    one = record(law, waves(), radius=0.9, slope=1.6, w1=0.8, w2=0.3)
    data = Dataset((replace(one, units={"time": "s", "input": "V", "output": "um"}),))
    options = FitOptions(budget=300, seed=1)
    found = fit_records(data, "prandtl-ishlinskii", settings={"plays": 2}, options=options)
    write_model(tmp_path / "model.json", found.model)
    again = read_model(tmp_path / "model.json")
    assert [q.name for q in again.system.parameters] == ["radius", "slope", "w1", "w2"]
    assert again.parameters["radius"].unit == "V"
    predicted = again.predict(data).records[0].output
    assert np.array_equal(predicted, found.model.predict(data).records[0].output)
    assert found.records["relative_rms"].max() < 0.02
