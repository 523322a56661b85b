"""How far from a known truth a search ended: in what the output sees, and parameter by parameter."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.study.afterwards.recovery import recovery
from hysteresis_bench.study.problems import build_problem
from hysteresis_bench.study.study_file import ProblemSpec
from hysteresis_plugins.models.free_energy_gma import FreeEnergyGma
from hysteresis_plugins.rigs.gma_known_truth import TRUTH

NAMES = [parameter.name for parameter in FreeEnergyGma.parameters]


def built(rig="gma-known-truth", **more):
    spec = ProblemSpec(name="a", model="free-energy-gma", rig=rig, fitted=["sine-50hz"], **more)
    return build_problem(spec, seed=1, folder=Path())


def trials(*found, status="done"):
    return pd.DataFrame(
        [
            {"optimizer": "pso", "trial": i, "status": status, "relative_rms": 0.0}
            | {f"parameter.{name}": value for name, value in (TRUTH | values).items()}
            for i, values in enumerate(found)
        ]
    )


def test_the_rig_is_the_model_at_its_truth():
    of = built()
    record = of.dataset.records[0]
    simulated = of.problem.system.respond(record, np.array([[TRUTH[n]] for n in of.problem.space.names]))[:, 0]
    np.testing.assert_array_equal(simulated, record.measured)
    inside = of.problem.space.to_unit(np.array([[TRUTH[n]] for n in of.problem.space.names]))
    assert np.all((inside > 0.0) & (inside < 1.0))


def test_what_the_output_cannot_see_is_no_error_of_the_combinations():
    alike = {"lambda_s": 4 * TRUTH["lambda_s"], "M_s": 2 * TRUTH["M_s"]}
    told = recovery(trials({}, alike, {"c": 1.1 * TRUTH["c"]}), built())
    assert told["combinations"] == ["M_R eta", "lambda_s M_R^2 alpha^2 / M_s^2", "H_c", "b", "c"]
    assert [row["combinations"] for row in told["trials"]] == pytest.approx([0.0, 0.0, 0.1], abs=1e-12)
    assert [row["parameters"] for row in told["trials"]] == pytest.approx([0.0, 3.0, 0.1])


def test_with_the_redundant_ones_fixed_every_parameter_counts():
    fixed = {name: TRUTH[name] for name in ("lambda_s", "M_s", "alpha")}
    told = recovery(trials({"M_R": 2 * TRUTH["M_R"], "eta": 0.5 * TRUTH["eta"]}), built(fixed=fixed))
    assert told["combinations"] == ["M_R", "eta", "H_c", "b", "c"]
    assert told["trials"][0]["combinations"] == pytest.approx(1.0)


def test_no_truth_no_answer():
    assert recovery(trials({}), built(rig="gma")) is None
    assert recovery(trials({}, status="raised"), built())["trials"] == []


def test_the_count_at_which_six_digits_are_reached_for_good():
    points = np.repeat(np.array([[TRUTH[name] for name in NAMES]]), 4, axis=0)
    points[:, NAMES.index("H_c")] *= np.array([1.5, 1.0 + 1e-8, 1.2, 1.0 + 1e-8])
    trace = Trace(np.array([3, 7, 20, 41]), np.array([4.0, 3.0, 2.0, 1.0]), points)
    short = Trace(trace.evaluations[:1], trace.losses[:1], trace.points[:1])
    table = trials({}, {}).assign(problem="a")
    told = recovery(table, built(), {("a", "pso", 1, 0): trace, ("a", "pso", 1, 1): short})
    assert [row["evaluations"] for row in told["trials"]] == [41, None]
