"""The whole magnetostrictive actuator, and the proof that five of its eight parameters can be found."""

from __future__ import annotations

import numpy as np
import pytest

from hysteresis_bench.compose import System
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.fitting import fit_records
from hysteresis_bench.fit.identifiability.analysis import analyse
from hysteresis_bench.fit.least_squares import polish
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Record
from hysteresis_plugins.models.free_energy import FreeEnergy
from hysteresis_plugins.models.free_energy_gma import REDUCED, FreeEnergyGma
from hysteresis_plugins.rigs.gma import GmaRig

NAMES = tuple(q.name for q in FreeEnergyGma.parameters)
VALUES = np.array([1e-3, 7.65e5, 4.7e5, 1.3, 2.4e3, 3.7e4, 0.5, 2e-9])
TIME = np.arange(1000) / 25e3
CURRENT = 2.5 * np.sin(2 * np.pi * 50.0 * TIME)
TOLD = (
    "lambda_s, M_s, M_R, eta and alpha act only through M_R eta and lambda_s M_R^2 alpha^2 / M_s^2: "
    "fix 3, for example lambda_s, M_s and alpha."
)


def response(model, values=VALUES, record=None):
    return System(model).respond(record or Record(TIME, CURRENT, None), values[:, None])[:, 0]


def problem(model, noise=0.0, fixed=None):
    clean = response(model)
    output = clean + noise * np.ptp(clean) * np.random.default_rng(0).standard_normal(clean.size)
    return posed(System(model, fixed=fixed or {}), Record(TIME, CURRENT, output))


def posed(system, record):
    return Problem(system, (record,), Space(system.box((record,))), LOSSES["rmse"])


def test_slow_current_gives_the_static_chain_of_equations_1_4_and_5():
    slow = Record(TIME * 1e4, CURRENT, None)
    field = 14400.0 * CURRENT + 40e3
    magnetization = System(FreeEnergy()).simulate(Record(TIME, field, None).signal, VALUES[2:, None])[:, 0]
    strain = 1.5 * 1e-3 * (magnetization / 7.65e5) ** 2
    expected = 1e6 * 7.85e-5 * (30e9 * strain - 1e6) / 3.375e7
    found = response(FreeEnergyGma(bias_field=40e3, prestress=1e6), record=slow)
    np.testing.assert_allclose(found, expected, atol=1e-4 * np.ptp(expected))
    # where the time is only an index the rod follows at once
    index = Record(TIME, CURRENT, None, units={"time": "sample", "input": "A", "output": "um"})
    found = response(FreeEnergyGma(bias_field=40e3, prestress=1e6), record=index)
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_bias_comes_from_the_setting_or_the_record():
    column = Record(TIME, CURRENT, None, columns={"bias_field": np.full(TIME.size, 40e3)})
    np.testing.assert_array_equal(response(FreeEnergyGma(), record=column), response(FreeEnergyGma(bias_field=40e3)))
    np.testing.assert_array_equal(response(FreeEnergyGma(bias_field=0.0), record=column), response(FreeEnergyGma()))


@pytest.mark.parametrize("noise", [0.0, 0.002, 0.02])
def test_five_of_eight(noise):
    found = analyse(problem(FreeEnergyGma(bias_field=40e3), noise), VALUES)
    assert found.rank == found.determined == 5
    assert TOLD in found.sentences()
    seen = dict(zip(NAMES, np.isfinite(found.standard_errors), strict=True))
    assert [name for name, known in seen.items() if known] == ["H_c", "b", "c"]


def test_five_of_eight_on_the_rig_and_all_of_the_reduced_five():
    record = GmaRig().measure("sine-50hz", np.random.default_rng(0)).records[0]
    whole = posed(System(FreeEnergyGma()), record)
    best = polish(whole, VALUES)
    found = analyse(whole, best)
    assert found.rank == found.determined == 5
    assert TOLD in found.sentences()
    reduced = posed(System(FreeEnergyGma(), fixed=REDUCED), record)
    fewer = polish(reduced, VALUES[2:7])
    assert analyse(reduced, fewer).rank == 5
    squares = [p.squares(p.space.to_unit(v[:, None]))[0] for p, v in ((whole, best), (reduced, fewer))]
    np.testing.assert_allclose(squares[1], squares[0], rtol=1e-6)


def test_clean_data_give_the_combinations_back():
    reduced = problem(FreeEnergyGma(bias_field=40e3), fixed=REDUCED)
    found = polish(reduced, VALUES[2:7] * np.array([0.7, 1.4, 1.3, 0.8, 1.2]))
    np.testing.assert_allclose(found, VALUES[2:7], rtol=1e-4)


def test_finite_in_the_corners_of_the_box():
    box = [p.lower if k % 2 else p.upper for k, p in enumerate(FreeEnergyGma.parameters)]
    corners = np.array(np.meshgrid(*[[q.lower, q.upper] for q in FreeEnergyGma.parameters])).reshape(len(box), -1)
    assert np.all(
        np.isfinite(System(FreeEnergyGma(bias_field=40e3)).simulate(Record(TIME, CURRENT, None).signal, corners))
    )


def test_advice_on_data_that_cannot_be_followed():
    flat = Record(TIME, 0 * CURRENT, 0 * CURRENT, "flat")
    rising = Record(TIME, TIME, TIME, "rising")
    unbiased = Record(TIME, CURRENT, CURRENT, "unbiased")
    below = Record(TIME, CURRENT, -1.0 - CURRENT**2, "below")
    good = GmaRig().measure("sine-50hz", np.random.default_rng(0)).records[0]
    told = [" ".join(FreeEnergyGma().advice((record,))) for record in (flat, rising, unbiased, below, good)]
    assert "nothing to identify" in told[0]
    assert "never turns" in told[1]
    assert "twice the current's frequency" in told[2]
    assert "below 0 um" in told[3]
    assert told[4] == ""


def test_advice_on_a_field_that_switches_nothing_and_on_less_than_a_period():
    weak = Record(TIME, 1e-3 * CURRENT, 1e-3 * CURRENT, "weak")
    assert "never reaches the switching range" in " ".join(FreeEnergyGma().advice((weak,)))
    biased = FreeEnergyGma(bias_field=40e3)
    noise = 0.01 * np.random.default_rng(0).standard_normal(400)
    half = Record(TIME[:400], CURRENT[:400] + noise, 20 + CURRENT[:400], "half")
    assert "less than a period" in " ".join(biased.advice((half,)))
    assert biased.advice((Record(TIME, CURRENT, 20 + CURRENT),)) == ()


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({"fixed": {"M_s": 0.0}}, "M_s = 0 must be above 0"),
        ({"bounds": {"b": (-1.0, 2.0)}}, "b: must be above 0"),
        ({"fixed": {"c": np.nan}}, "c = nan must be finite"),
    ],
)
def test_widths_and_saturation_must_be_above_zero(arguments, told):
    dataset = GmaRig().measure("sine-50hz", np.random.default_rng(0))
    with pytest.raises(UserError, match=told):
        fit_records(dataset, "free-energy-gma", **arguments)


def test_refuses_a_saturation_of_zero_and_impossible_settings():
    with pytest.raises(ValueError, match="M_s must be above 0"):
        response(FreeEnergyGma(), np.where(np.array(NAMES) == "M_s", 0.0, VALUES))
    with pytest.raises(ValueError, match="stiffness"):
        FreeEnergyGma(stiffness=0.0)
