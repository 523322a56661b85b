"""A law of many linear parameters is solved for by `fit`, not searched."""

import numpy as np
from rich.console import Console

from hysteresis_bench import fit
from hysteresis_bench.fit.smooth.smoothing import SOLVED
from hysteresis_bench.report.fit.folder import print_fit, spared, spared_words
from hysteresis_bench.signals import Dataset, Record
from hysteresis_plugins.models.preisach_hats import PreisachHats
from tests.plugins.truths import simulated

TIME = np.linspace(0.0, 4.0, 240)


def record(amplitude: float, name: str) -> Record:
    law, u = PreisachHats(plays=2, pieces=3), amplitude * np.sin(2.0 * np.pi * TIME)
    rises = {"w0_2": 0.4, "w1_2": 0.5, "w2_2": 0.3}
    known = {q.name: rises.get(q.name, 0.0) for q in law.parameters}
    y = simulated(law, u, TIME, **{**known, "radius": 1.0, "grading": 1.0, "slope": 0.2})
    return Record(TIME, u, y + 1e-3 * np.random.default_rng(0).standard_normal(y.size), name=name)


def test_a_smooth_density_is_solved_for_and_predicts_what_is_held_out():
    records = (record(1.0, "one"), record(0.6, "two"), record(0.8, "three"))
    found = fit(Dataset(records, ("three",)), "preisach-hats", settings={"plays": 3, "pieces": 6})
    assert found.agreement == SOLVED
    assert found.notes[0].startswith(SOLVED)
    errors = found.records.set_index("record")["rmse"]
    assert errors["three"] < 0.02 * np.ptp(records[2].output)
    assert not [one for one in found.warnings if one.startswith("w")]
    weights = found.parameters[found.parameters["name"].str.match(r"w\d")]
    assert weights["standard_error"].isna().all()
    assert np.isfinite(found.parameters.set_index("name").loc["radius", "standard_error"])


def test_the_terminal_leaves_out_weights_of_which_no_single_one_is_determined():
    records = (record(1.0, "one"), record(0.6, "two"))
    few, many = (
        fit(Dataset(records), "preisach-hats", settings={"plays": 2, "pieces": pieces}).model for pieces in (3, 12)
    )
    assert spared(few) == []
    weights = [name for name in many.parameters if name.startswith("w")]
    assert {*weights} <= {*spared(many)}
    assert "radius" not in spared(many)
    console = Console(record=True, width=100)
    print_fit(fit(Dataset(records), "preisach-hats", settings={"plays": 2, "pieces": 12}), console)
    said = console.export_text()
    assert spared_words(spared(many), "parameters.csv") in said
    assert "w1_5" not in said
