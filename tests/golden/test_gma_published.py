"""The magnetostrictive paper's constants and claims as printed, and its audit borne out by arithmetic.

Chang G., Zhang Y., Parameter Identification of GMA Nonlinear Dynamics Model Based on ICPSO.
"""

import tomllib
from pathlib import Path

import pytest

from hysteresis_bench.report.paper.audit import audit
from hysteresis_bench.report.paper.published import check_published
from hysteresis_bench.study.study_file import read_study
from hysteresis_plugins.models.free_energy_gma import REDUCED, FreeEnergyGma
from hysteresis_plugins.optimizers.icpso import Icpso
from hysteresis_plugins.rigs._gma_bench import PRINTED
from hysteresis_plugins.rigs.gma_known_truth import TRUTH

STUDIES = Path(__file__).parents[2] / "studies"


@pytest.fixture(scope="module")
def published():
    return check_published(tomllib.loads((STUDIES / "gma.published.toml").read_text(encoding="utf-8")))


@pytest.fixture(scope="module")
def study():
    return read_study(STUDIES / "gma.toml")[0]


def test_printed_constants_are_those_of_the_model_and_of_the_rig(published):
    columns = published.tables["constants"].columns
    printed = dict(zip(columns["constant"], columns["value"], strict=True))
    model = FreeEnergyGma()
    names = {"n": "turns", "A_r": "area", "M_z": "mass", "C": "damping", "K": "stiffness"}
    for symbol, name in names.items():
        assert printed[symbol] == getattr(model, name) == PRINTED[name] == published.values[name]
    assert printed == {"n": 14400, "A_r": 7.85e-5, "M_z": 0.5, "C": 4.325e3, "K": 3.375e7, "rod": "Φ10 × 90"}


def test_the_printed_results_and_what_may_be_compared(published):
    printed = {(result.optimizer, result.metric): result.value for result in published.result}
    assert printed == {("icpso", "fitness"): 22.74, ("icpso", "max_error"): 0.03}
    assert published.comparable == ["max_error"]


def test_every_audited_statement_with_arithmetic_is_borne_out(published):
    computed = [finding for finding in audit(published) if finding.entry.arithmetic]
    assert len(computed) >= 20
    wrong = [(found.entry.says, found.value, found.fault) for found in computed if found.borne_out is not True]
    assert wrong == []


def test_numbers_of_the_audit_are_those_of_the_code(published, study):
    values = published.values
    optimizer = Icpso()
    assert (values["N"], values["M2"]) == (optimizer.particles, optimizer.chaos_steps)
    assert optimizer.evaluations_per_iteration(8) == 3 * values["N"] + values["M2"]
    assert values["searched"] == len(FreeEnergyGma.parameters)
    assert values["seen"] == len(FreeEnergyGma.parameters) - len(REDUCED)
    budgets = {spec.name: study.budget_of(spec) for spec in study.optimizer}
    assert budgets["pso"] == budgets["icpso"] == values["N"] * (1 + published.iterations)
    cost = optimizer.evaluations_per_iteration(8)
    assert budgets["icpso, 300 iterations"] == values["N"] + published.iterations * cost


def test_the_reduced_problems_fix_what_the_truth_has(study):
    reduced = [spec for spec in study.problem if spec.fixed]
    assert len(reduced) == 2
    for spec in reduced:
        assert spec.fixed == REDUCED == {name: TRUTH[name] for name in REDUCED}
