"""What a fit says of its parameters and of the records: edges of the box, advice of the law."""

from dataclasses import replace

import numpy as np
import pandas as pd

from hysteresis_bench import fit, registry
from hysteresis_bench.compose import System
from hysteresis_bench.fit.checks.advised import advice_with
from hysteresis_bench.fit.checks.edges import at_edges, edges_reached
from hysteresis_bench.fit.fitting import FitOptions, fit_records
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 3.0, 400)
DRIVE = 4.0 * np.sin(5.0 * TIME)


def record_of(output, drive=DRIVE):
    return Record(time=TIME, input=drive, output=output, name="sine")


def test_a_weight_of_about_0_is_at_no_edge_and_a_width_at_the_end_of_its_box_is():
    system, records = (
        System(registry.build("models", "prandtl-ishlinskii", {})),
        (record_of(4.0 * np.sin(5.0 * TIME - 0.2)),),
    )
    problem = Problem(system, records, Space(system.box(records)), LOSSES["rmse"])
    low, high = (np.array([getattr(p, end) for p in problem.space.parameters]) for end in ("lower", "upper"))
    middle = 0.5 * (low + high)
    assert not edges_reached(problem, middle).any()
    weights = np.char.startswith(problem.space.names, "w")
    assert weights.sum() == 12
    near = np.where(weights, low + 1e-5 * (high - low), middle)
    assert not edges_reached(problem, near).any()
    assert edges_reached(problem, np.where(weights, high, middle)).tolist() == weights.tolist()
    assert edges_reached(problem, low)[problem.space.names.index("radius")]


def test_parameters_at_edges_are_told_together():
    columns = {"name": ["a", "b", "c"], "value": [0.25, 3.0, 1e-5]}
    parameters = pd.DataFrame({**columns, "at_bound": [True, False, True]})
    assert at_edges(parameters) == [
        "a and c lie at the edges of their boxes (0.25 and 1e-05): the optimum may lie outside, and their standard "
        "errors mean little."
    ]
    (alone,) = at_edges(parameters[:2])
    assert alone.startswith("a lies at the edge of its box (0.25): the optimum may lie outside, and its standard error")
    assert at_edges(parameters[1:2]) == []


def test_a_law_asks_for_an_offset_only_where_no_effect_has_it():
    record, dahl = record_of(DRIVE + 50.0), registry.build("models", "dahl", {})
    assert "Add the effect bias" in " ".join(advice_with(dahl, (), [record]))
    assert "Add the effect bias" in " ".join(advice_with(dahl, ("input-lag",), [record]))
    for effect in ("bias", "record-offset"):
        assert advice_with(dahl, (effect,), [record]) == ()


def test_jiles_atherton_says_where_its_units_cannot_be_right():
    law = registry.build("models", "jiles-atherton", {})
    (told,) = advice_with(law, (), [record_of(1e-6 * DRIVE)])
    assert "moves by less than mu0 H alone" in told
    assert advice_with(law, (), [record_of(2e-6 * DRIVE)]) == ()


def test_an_offset_leaves_the_other_advice_of_a_law_as_it_is():
    falls, bouc_wen = record_of(50.0 - DRIVE), registry.build("models", "bouc-wen", {})
    (told,) = advice_with(bouc_wen, ("bias",), [falls])
    assert "The output falls as the input rises in sine" in told


def test_a_fit_with_a_bias_does_not_ask_for_one():
    data = Dataset((record_of(0.5 * DRIVE + 20.0),))
    told = {
        effects: " ".join(fit_records(data, "dahl", effects, options=FitOptions(budget=40)).warnings)
        for effects in ((), ("bias",))
    }
    assert "Add the effect bias" in told[()]
    assert "Add the effect bias" not in told["bias",]


def test_a_held_out_record_that_goes_further_is_said_to_be_an_extrapolation():
    near, far = (replace(record_of(0.8 * size * DRIVE, size * DRIVE), name=name) for size, name in ((1, "a"), (2, "b")))
    told = " ".join(fit(Dataset((near, far), ("b",)), "dahl", options=FitOptions(budget=40)).warnings)
    assert "b: 6" in told
    assert "% of its samples lie beyond the fitted inputs (-4 to 4): its error tells of an extrapolation." in told
    other = " ".join(fit(Dataset((near, far), ("a",)), "dahl", options=FitOptions(budget=40)).warnings)
    assert "extrapolation" not in other
