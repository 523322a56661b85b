"""Identifiability against closed forms, products and sums that the data cannot take apart, and noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Model
from hysteresis_bench.fit.identifiability.analysis import analyse, profile
from hysteresis_bench.fit.identifiability.combinations import Blindness, Combination, blind_groups, sparsest
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Record
from hysteresis_plugins.models.free_energy import FreeEnergy

TIME = np.linspace(0.0, 1.0, 400)


@dataclass(frozen=True)
class Line(Model):
    """slope u + intercept."""

    parameters = (Parameter("slope", -5.0, 5.0), Parameter("intercept", -5.0, 5.0))

    def simulate(self, signal, p):
        return p.slope * signal.input + p.intercept


@dataclass(frozen=True)
class Tied(Model):
    """A product, a sum of two, one that does nothing, and one that stands alone."""

    parameters = (
        Parameter("a", 0.1, 10.0, scaling="log"),
        Parameter("b", 0.1, 10.0, scaling="log"),
        Parameter("rate", 0.1, 10.0, scaling="log"),
        Parameter("first", 0.0, 10.0),
        Parameter("second", 0.0, 10.0),
        Parameter("idle", -1.0, 1.0),
    )

    def simulate(self, signal, p):
        return p.a**2 * p.b * np.sin(p.rate * signal.input) + p.first + p.second


def problem(model, values, noise=0.0, seed=0, fixed=None, input_=None):
    system = System(model, fixed=fixed or {})
    drive = 3.0 * np.sin(6.0 * np.pi * TIME) if input_ is None else input_
    clean = system.simulate(Record(TIME, drive, None).signal, np.asarray(values)[:, None])[:, 0]
    spread = noise * np.ptp(clean)
    record = Record(TIME, drive, clean + spread * np.random.default_rng(seed).standard_normal(TIME.size))
    return Problem(system, (record,), Space(system.parameters), LOSSES["rmse"])


def fitted_line(noise):
    record = Record(TIME, TIME, 2.0 * TIME - 1.0 + noise)
    posed = Problem(System(Line()), (record,), Space(Line.parameters), LOSSES["rmse"])
    design = np.column_stack([TIME, np.ones_like(TIME)])
    return posed, design, np.linalg.lstsq(design, record.output, rcond=None)[0]


def test_standard_errors_of_a_line_against_the_closed_form():
    posed, design, best = fitted_line(0.1 * np.random.default_rng(3).standard_normal(TIME.size))
    found = analyse(posed, best, correlated=False)
    residuals = posed.records[0].output - design @ best
    covariance = np.linalg.inv(design.T @ design) * (residuals @ residuals) / (TIME.size - 2)
    np.testing.assert_allclose(found.standard_errors, np.sqrt(np.diag(covariance)), rtol=1e-6)
    expected = covariance[0, 1] / np.sqrt(covariance[0, 0] * covariance[1, 1])
    np.testing.assert_allclose(found.correlation, [[1.0, expected], [expected, 1.0]], rtol=1e-6)
    assert found.rank == found.determined == 2
    assert found.sentences() == ()


def test_correlated_residuals_widen_the_errors_as_far_as_they_must():
    # over many draws of AR(1) noise the standard errors must match the scatter of the estimates
    rng = np.random.default_rng(5)
    estimates, told, naive = [], [], []
    for _ in range(60):
        shocks = rng.standard_normal(TIME.size)
        noise = np.empty(TIME.size)
        noise[0] = shocks[0] / np.sqrt(1 - 0.8**2)
        for k in range(1, TIME.size):
            noise[k] = 0.8 * noise[k - 1] + shocks[k]
        posed, _, best = fitted_line(0.1 * noise)
        estimates.append(best)
        told.append(analyse(posed, best).standard_errors)
        naive.append(analyse(posed, best, correlated=False).standard_errors)
    ratio = np.mean(told, axis=0) / np.std(estimates, axis=0)
    assert np.all((ratio > 0.7) & (ratio < 1.3))
    # theory: sqrt((1 + 0.8) / (1 - 0.8)) = 3 for white noise taken instead
    assert np.all(np.mean(naive, axis=0) / np.std(estimates, axis=0) < 0.45)


@pytest.mark.parametrize("noise", [0.0, 0.05])
def test_products_sums_and_idle_parameters_are_told(noise):
    values = np.array([2.0, 0.5, 1.3, 3.0, 1.0, 0.2])
    found = analyse(problem(Tied(), values, noise), values)
    assert found.rank == 3
    assert [str(blindness) for blindness in found.blind] == [
        "idle does not act on these data at all.",
        "a and b act only through a^2 b: fix one, for example a.",
        "first and second act only through first + second: fix one, for example first.",
    ]
    assert list(np.isfinite(found.standard_errors)) == [False, False, True, False, False, False]


def test_of_many_parameters_a_sentence_counts_the_others():
    names = tuple(f"w{k}" for k in range(1, 21))
    few = Blindness(names[:3], (Combination("sum", (("w1", 1.0), ("w2", 1.0))),), names[:1])
    assert str(few) == "w1, w2 and w3 act only through w1 + w2: fix one, for example w1."
    alone = tuple(Combination("sum", ((name, 1.0),)) for name in names[:11])
    assert str(Blindness(names, alone, names[:9])) == (
        "w1, w2, w3, w4, w5, w6, w7, w8 and 12 more act only through 11 combinations of them: fix 9, for example w1, "
        "w2, w3, w4, w5, w6, w7, w8 and 1 more."
    )
    assert str(Blindness(names, (), ())).startswith("w1, w2, w3, w4, w5, w6, w7, w8 and 12 more do not act")


def test_fixing_what_was_told_makes_the_rest_identifiable():
    values = np.array([2.0, 0.5, 1.3, 3.0, 1.0, 0.2])
    tied = analyse(problem(Tied(), values, 0.01), values)
    fixed = {name: values[tied.names.index(name)] for blindness in tied.blind for name in blindness.fix}
    kept = np.array([value for name, value in zip(tied.names, values, strict=True) if name not in fixed])
    found = analyse(problem(Tied(), kept, 0.01, fixed=fixed), kept)
    assert found.rank == len(found.names) == 3
    assert np.all(np.isfinite(found.standard_errors))


@pytest.mark.parametrize("noise", [0.0, 0.01])
def test_free_energy_has_five_combinations_of_six(noise):
    values = np.array([1.0, 20.0, 0.2, 0.4, 0.3, 5.0])
    found = analyse(problem(FreeEnergy(), values, noise, input_=np.sin(8 * np.pi * TIME) * (1 - 0.5 * TIME)), values)
    assert found.rank == found.determined == 5
    assert str(found.blind[0]) == (
        "M_R, eta and alpha act only through M_R eta and M_R alpha: fix one, for example M_R."
    )


def test_a_field_that_never_switches_is_told():
    # every relay's coercive field is beyond the field: only the slope of the kernels acts
    values = np.array([1.0, 20.0, 1.0, 0.4, 0.1, 5.0])
    found = analyse(problem(FreeEnergy(), values, 0.01, input_=0.05 * np.sin(8 * np.pi * TIME)), values)
    assert found.rank == 1
    assert str(found.blind[0]) == "M_R does not act on these data at all."
    # b c exp(c^2) at c = 0.1 is locally b c^1.02
    assert "act only through eta / (H_c b c^1.02 alpha)" in str(found.blind[1])


def test_values_outside_the_box_are_analysed_where_they_are():
    values = np.array([2.0, 0.5, 1.3, 3.0, 1.0, 0.2])
    posed = problem(Tied(), values, 0.01)
    narrow = tuple(q.within(3.0, 4.0) if q.name == "a" else q for q in posed.space.parameters)
    outside = Problem(posed.system, posed.records, Space(narrow), posed.loss)
    np.testing.assert_allclose(
        analyse(outside, values).singular_values, analyse(posed, values).singular_values, rtol=1e-6, atol=1e-6
    )


def test_noise_hides_a_direction_that_the_output_sees():
    posed = problem(Line(), [1e-3, 0.0], noise=1e5)
    found = analyse(posed, np.array([1e-3, 0.0]))
    assert found.rank == 2
    assert found.determined < 2
    assert any("Noise hides" in sentence for sentence in found.sentences())


def test_a_value_at_its_bound_is_no_obstacle():
    found = analyse(problem(Line(), [5.0, -5.0], 0.01), np.array([5.0, -5.0]))
    assert found.rank == 2
    assert np.all(np.isfinite(found.standard_errors))


def test_parameters_of_very_different_size_are_told_as_products():
    values = np.array([1e-3, 7e5, 3.0, 5e-9])
    exponents = np.array([[1.0, -2.0, 2.0, 0.0], [0.0, 0.0, 1.0, -1.0]])
    lost = values[:, None] * np.linalg.svd(exponents)[2][2:].T
    (found,) = blind_groups(("s", "m", "r", "t"), values, lost)
    assert str(found) == "s, m, r and t act only through r / t and s r^2 / m^2: fix 2, for example s and m."


def test_sparsest_basis_of_a_mixed_space():
    plain = np.array([[1.0, -2.0, 2.0, 0.0, 2.0], [0.0, 0.0, 1.0, 1.0, 0.0]])
    mixed = np.array([[0.3, 1.7], [-2.0, 0.4]]) @ plain
    np.testing.assert_array_equal(sparsest(mixed), [[0, 0, 1, 1, 0], [1, -2, 2, 0, 2]])


def test_combinations_in_words():
    assert str(Combination("product", (("a", 1.0), ("b", 2.0), ("c", -2.0)))) == "a b^2 / c^2"
    assert str(Combination("product", (("a", -1.0), ("c", -0.5)))) == "1 / (a c^0.5)"
    assert str(Combination("sum", (("a", 1.0), ("b", -2.0)))) == "a - 2 b"


def test_profile_of_a_line_against_the_closed_form():
    posed, _, best = fitted_line(0.1 * np.random.default_rng(3).standard_normal(TIME.size))
    grid = best[0] + np.linspace(-0.1, 0.1, 5)
    found = profile(posed, "slope", grid, values=best)
    target = posed.records[0].output
    for slope, squares, intercept in zip(grid, found.squares, found.values[1], strict=True):
        rest = target - slope * TIME
        np.testing.assert_allclose(intercept, rest.mean(), rtol=1e-5)
        np.testing.assert_allclose(squares, np.sum((rest - rest.mean()) ** 2), rtol=1e-8)
    assert np.argmin(found.ratio) == 2
    assert abs(found.ratio[2]) < 1e-6


def test_profile_along_a_blind_direction_is_flat():
    values = np.array([2.0, 0.5, 1.3, 3.0, 1.0, 0.2])
    posed = problem(Tied(), values, 0.01)
    found = profile(posed, "a", np.array([1.6, 2.0, 2.4]), values=values)
    assert np.max(found.ratio) - np.min(found.ratio) < 1e-3


def test_refuses_what_makes_no_sense():
    posed = problem(Line(), [1.0, 0.0], 0.01)
    with pytest.raises(ValueError, match="slop"):
        profile(posed, "slop", np.array([0.0]), values=np.array([1.0, 0.0]))
    with pytest.raises(ValueError, match="leaves the box"):
        profile(posed, "slope", np.array([9.0]), values=np.array([1.0, 0.0]))
    short = Problem(posed.system, (posed.records[0].take(slice(0, 2)),), posed.space, posed.loss)
    with pytest.raises(ValueError, match="2 samples"):
        analyse(short, np.array([1.0, 0.0]))
