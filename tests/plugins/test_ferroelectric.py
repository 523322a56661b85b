"""The ferroelectric law, and what it offers, on data of known truth."""

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.signals import INDEX, Record
from hysteresis_plugins.effects.leakage import Leakage
from hysteresis_plugins.models.ferroelectric import Ferroelectric
from tests.plugins.truths import TIME, held, record, simulated, solved, waves

TRUTH = {**Ferroelectric.example.parameters}


def test_saturations_are_found_again_inside_the_box():
    law = Ferroelectric()
    one = record(law, waves(4.0), **TRUTH)
    found = solved(law, one, **{name: value for name, value in TRUTH.items() if name not in law.linear})
    np.testing.assert_allclose([found[name] for name in law.linear], [TRUTH[name] for name in law.linear], rtol=1e-8)
    assert not held(law, [one], TRUTH)


def test_coercive_fields_grow_with_the_logarithm_of_the_frequency():
    law = Ferroelectric()
    system = System(law, registry.build_effects(law, ["threshold-rate"]))
    u = waves(4.0)
    column = np.array([[*(TRUTH[q.name] for q in law.parameters), 0.05]]).T
    records = [Record(TIME / factor, u, None) for factor in (1.0, 100.0)]
    slow, fast = (system.simulate(one.signal, column)[:, 0] for one in records)
    cycles = np.sum(np.abs(np.diff(u))) / (2.0 * np.ptp(u)) / 6.0
    for found, rate in ((slow, cycles), (fast, 100.0 * cycles)):
        grown = {f"r_{i}": TRUTH[f"r_{i}"] * (1.0 + 0.05 * np.log(rate)) for i in "12"}
        np.testing.assert_allclose(found, simulated(law, u, **{**TRUTH, **grown}), atol=1e-12)
    offered = law.offers["threshold-rate"]
    assert "one frequency" in offered.inapplicable(records[:1])
    assert offered.inapplicable(records) == ""


def test_leakage_is_the_integral_of_the_input():
    law = Ferroelectric()
    system = System(law, (("leakage", Leakage()),))
    u = waves(4.0, centre=1.0)
    column = np.array([[*(TRUTH[q.name] for q in law.parameters), 0.3]]).T
    found = system.simulate(Record(TIME, u, None).signal, column)[:, 0] - simulated(law, u, **TRUTH)
    expected = [0.3 * np.trapezoid(u[: k + 1], TIME[: k + 1]) for k in range(0, TIME.size, 100)]
    np.testing.assert_allclose(found[::100], expected, atol=1e-12)
    index = {"time": INDEX, "input": "V", "output": "C"}
    assert "index" in Leakage().inapplicable([Record(TIME, u, u, units=index)])
