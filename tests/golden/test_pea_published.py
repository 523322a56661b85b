"""The piezoelectric paper's Tables 1 to 6 as printed, and its audit borne out by arithmetic.

Modeling of piezoelectric actuators with a particle swarm genetic hybrid (G-Pmix), Micromachines 14 (2023) 1050.
"""

import tomllib
from pathlib import Path

import numpy as np
import pytest

from hysteresis_bench.report.paper.audit import audit
from hysteresis_bench.report.paper.published import check_published
from hysteresis_bench.study.study_file import read_study
from hysteresis_plugins.optimizers.gpmix import Gpmix
from hysteresis_plugins.rigs.pea_known_truth import PUBLISHED

STUDIES = Path(__file__).parents[2] / "studies"


@pytest.fixture(scope="module")
def published():
    return check_published(tomllib.loads((STUDIES / "pea.published.toml").read_text(encoding="utf-8")))


def test_table_1_is_what_gpmix_does_by_default(published):
    columns = published.tables["table_1"].columns
    printed = dict(zip(columns["parameter"], columns["value"], strict=True))
    ours = Gpmix()
    assert printed == {
        "Maxgen": 4000,
        "S": ours.particles,
        "c1s": ours.cognitive[0],
        "c1f": ours.cognitive[1],
        "c2s": ours.social[0],
        "c2f": ours.social[1],
        "omega_min": ours.inertia[1],
        "omega_max": ours.inertia[0],
        "Pc": ours.crossover_probability,
        "Pm": ours.mutation_probability,
    }
    assert published.iterations == printed["Maxgen"]


def test_table_2_is_the_static_section(published):
    assert published.tables["table_2"].columns == {
        "optimizer": ["gpmix", "pso", "ga"],
        "alpha": [0.304225, 0.262017, 0.132514],
        "beta": [0.675313, 0.675520, 0.409838],
        "gamma": [0.497724, 0.368105, 1.048550],
        "d": [1.045814, 1.048355, 0.947412],
        "fitness": [0.029423, 0.031505, 0.288188],
    }
    printed = {(result.optimizer, result.metric): result.value for result in published.result}
    assert printed == {("gpmix", "fitness"): 0.029423, ("pso", "fitness"): 0.031505, ("ga", "fitness"): 0.288188}


def test_table_3_is_the_linear_section(published):
    assert published.tables["table_3"].columns == {
        "optimizer": ["gpmix", "ga", "pso"],
        "b": [267700, 327100, 228900],
        "c_over_m": [510.1069, 683.914, 386.7],
        "k_over_m": [255700, 284790, 225200],
    }


def test_the_known_truth_is_the_gpmix_columns(published):
    static, linear = (published.tables[name].columns for name in ("table_2", "table_3"))
    columns = [(static, name) for name in ("alpha", "beta", "gamma", "d")]
    columns += [(linear, name) for name in ("b", "c_over_m", "k_over_m")]
    assert [table[name][0] for table, name in columns] == list(PUBLISHED)


@pytest.mark.parametrize(
    ("record", "row"),
    [
        ("sine-10-hz", (0.0617, 0.0284, 0.1134, 0.0601, 0.1910, 0.0865)),
        ("sine-20-hz", (0.1306, 0.0775, 0.1781, 0.1047, 0.2463, 0.1531)),
        ("sine-30-hz", (0.0434, 0.0192, 0.0688, 0.0345, 0.1000, 0.0457)),
        ("sine-40-hz", (0.0336, 0.0141, 0.0706, 0.0413, 0.0791, 0.0515)),
        ("sine-50-hz", (0.1547, 0.0232, 0.0684, 0.0399, 0.1547, 0.1056)),
        ("damped-sine", (0.1784, 0.1501, 0.2301, 0.1868, 0.2451, 0.2553)),
    ],
)
def test_table_4_row_by_row(published, record, row):
    columns = published.tables["table_4"].columns
    place = columns["record"].index(record)
    assert tuple(columns[name][place] for name in list(columns)[1:]) == row
    assert list(columns)[1:] == ["gpmix_error", "gpmix_rmse", "pso_error", "pso_rmse", "ga_error", "ga_rmse"]


def test_tables_5_and_6_are_the_controller(published):
    assert published.tables["table_5"].columns["value"] == [0.304225, 0.675313, 0.497724, 1.045814]
    columns = published.tables["table_6"].columns
    assert columns["reference"] == ["ramp", "damped-sine", "sine-10-hz", "sine-30-hz", "sine-50-hz", "complex"]
    printed = np.array([columns[name] for name in ("gpmix_error", "gpmix_rmse", "pso_error", "pso_rmse")])
    expected = [
        [2.4739e-4, 1.2311e-5, 0.0078, 0.0539, 0.1134, 0.3375],
        [0.0011, 9.8599e-4, 0.0053, 0.0368, 0.0763, 0.0910],
        [2.5372e-4, 1.3309e-5, 0.0081, 0.0564, 0.1187, 0.3512],
        [0.0011, 0.0010, 0.0055, 0.0385, 0.0798, 0.0948],
    ]
    np.testing.assert_array_equal(printed, expected)


def test_every_audited_statement_with_arithmetic_is_borne_out(published):
    computed = [finding for finding in audit(published) if finding.entry.arithmetic]
    assert len(computed) >= 25
    assert [(finding.entry.where, finding.value, finding.fault) for finding in computed if not finding.borne_out] == []


def test_the_study_runs_what_the_claims_compare(published):
    study, _ = read_study(STUDIES / "pea.toml")
    over_instances, _ = read_study(STUDIES / "pea_instances.toml")
    asked = {name for claim in published.claim for name in (claim.better, claim.worse)}
    assert asked <= set(over_instances.labels)
    papers = {name for claim in published.claim if not claim.ablation for name in (claim.better, claim.worse)}
    assert papers <= set(study.labels)
    paper = [spec for spec in study.optimizer if spec.name in ("gpmix", "pso", "ga")]
    assert [study.budget_of(spec) for spec in paper] == [50 * (4000 + 1)] * 3
