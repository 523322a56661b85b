"""Stages: the linear section from a sweep, the whole model's errors, faults in the study file."""

import tomllib

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.errors import UserError
from hysteresis_bench.kernels.second_order import second_order
from hysteresis_bench.report.paper.published import Published, check_published
from hysteresis_bench.report.stages.section import stage_views
from hysteresis_bench.study.afterwards.linear_section import regressed, unstable
from hysteresis_bench.study.afterwards.stages import FITTED, LARGEST, RMSE, STAGED, run_stages
from hysteresis_bench.study.problems import build_problem
from hysteresis_bench.study.results import RESPONSES, STAGES, STUDY, read_results
from hysteresis_bench.study.store import Store
from hysteresis_bench.study.study_file import check_study, read_study
from hysteresis_plugins.rigs.pea_known_truth import PUBLISHED

LINEAR = {"b": 267_700.0, "c_over_m": 510.1069, "k_over_m": 255_700.0}

STUDY_TEXT = """
title = "t"
seed = 1
[[problem]]
name = "static"
rig = "pea-known-truth"
rig_settings = { noise = NOISE }
fitted = ["static-sine"]
model = "bouc-wen"
[[problem]]
name = "together"
rig = "pea-known-truth"
rig_settings = { noise = NOISE }
fitted = ["sweep"]
model = "hammerstein"
fixed = { d = 1.045814 }
[[optimizer]]
plugin = "pso"
[[stage]]
name = "linear"
after = "static"
optimizers = ["pso"]
model = "hammerstein"
fit = ["b", "c_over_m", "k_over_m"]
fitted = ["sweep"]
check = ["static-sine"]
beside = "together"
"""


def trials(**changed):
    """A trial of each problem that found the truth, but for what is changed."""
    found = PUBLISHED._asdict() | changed
    parameters = {f"parameter.{name}": value for name, value in found.items()}
    rows = [{"problem": name, "optimizer": "pso", "status": "done", "fitness": 0.1} for name in ("static", "together")]
    return pd.DataFrame([row | parameters for row in rows])


def staged(noise=0.0, rows=None):
    study = check_study(tomllib.loads(STUDY_TEXT.replace("NOISE", str(noise))), "t")
    built = {spec.name: build_problem(spec, study.seed, None) for spec in study.problem}
    return run_stages(study, trials() if rows is None else rows, built, folder=None)


def section(table):
    rows = table[(table["way"] == STAGED) & (table["quantity"] == FITTED) & (table["optimizer"] == "pso")]
    return rows.set_index("name")


def test_the_published_linear_section_is_recovered_from_noise_free_data():
    table, _ = staged()
    found = section(table)
    for name, value in LINEAR.items():
        assert found.loc[name, "value"] == pytest.approx(value, rel=1e-6)
    errors = table[(table["name"] == "sweep") & table["quantity"].isin([LARGEST, RMSE])]
    assert len(errors) == 8  # the optimizer and the best of all, staged and together
    assert errors["value"].max() < 1e-6


def test_with_noise_the_standard_errors_cover_the_truth():
    found = section(staged(noise=0.01)[0])
    for name, value in LINEAR.items():
        error = found.loc[name, "standard_error"]
        assert 0.0 < error < 0.01 * value
        assert abs(found.loc[name, "value"] - value) < 4.0 * error


def test_a_wrong_static_section_leaves_its_error_in_the_check():
    table, responses = staged(rows=trials(alpha=0.5))
    check = table[(table["way"] == STAGED) & (table["quantity"] == LARGEST) & (table["name"] == "static-sine")]
    assert (check["value"] > 0.05).all()
    part = responses[responses["optimizer"] == "pso"]
    assert check["value"].iloc[0] == pytest.approx(np.abs(part["simulated"] - part["output"]).max())


def sweep():
    time = np.arange(8000) * 5e-4
    return time, np.sin(2 * np.pi * (0.1 * time + 49.9 * time**2 / 8.0))


def test_the_regression_alone_comes_near_on_any_time_grid():
    rng = np.random.default_rng(3)
    time, v = sweep()
    keep = np.sort(rng.choice(time.size, 6000, replace=False))
    time, v = time[keep], v[keep]
    damping, stiffness = np.array([510.1069]), np.array([255_700.0])
    y = 267_700.0 / 255_700.0 * second_order(time, v[:, None], damping, stiffness)[:, 0]
    np.testing.assert_allclose(regressed([(time, v, y)]), [267_700.0, 510.1069, 255_700.0], rtol=0.02)


@pytest.mark.parametrize(
    ("values", "part"),
    [
        ([1.0, -2.0, 3.0], "damping would"),
        ([1.0, 2.0, -3.0], "stiffness would"),
        ([1.0, -2.0, -3.0], "damping and the stiffness"),
        ([np.nan, 1.0, 1.0], "no solution"),
    ],
)
def test_an_unstable_section_is_told(values, part):
    assert part in unstable(np.array(values))
    assert unstable(np.array([1.0, 2.0, 3.0])) == ""


def test_the_regression_sees_negative_damping():
    time, v = sweep()
    # the response of an anti-damped section, growing slowly enough to stay finite
    y = second_order(time, v[:, None], np.array([-1.0]), np.array([255_700.0]))[:, 0]
    assert regressed([(time, v, y)])[1] < 0.0


def test_an_unstable_section_is_a_flagged_row_and_no_number(tmp_path):
    time, v = sweep()
    y = second_order(time, v[:, None], np.array([-1.0]), np.array([255_700.0]))[:, 0]
    lines = ["time,input,output,run"]
    lines += [f"{t},{a},{b},sweep" for t, a, b in zip(time, v, y, strict=True)]
    lines += [f"{t},{a},{a},slow" for t, a in zip(time[:200], v[:200], strict=True)]
    (tmp_path / "data.csv").write_text("\n".join(lines))
    text = STUDY_TEXT.replace('rig = "pea-known-truth"\nrig_settings = { noise = NOISE }\n', 'data = ["data.csv"]\n')
    text = text.replace('"static-sine"', '"data:slow"').replace('"sweep"', '"data:sweep"')
    study = check_study(tomllib.loads(text), "t")
    built = {spec.name: build_problem(spec, study.seed, tmp_path) for spec in study.problem}
    table, responses = run_stages(study, trials(alpha=0.0, d=1.0), built, folder=tmp_path)
    mine = table[table["way"] == STAGED]
    assert mine["fault"].str.contains("unstable").all()
    assert mine[mine["quantity"].isin([LARGEST, RMSE])]["value"].isna().all()
    assert responses.empty

    (tmp_path / STUDY).write_text(text)
    table.to_csv(tmp_path / STAGES, index=False)
    with Store(tmp_path):
        pass
    (view,) = stage_views(read_results(tmp_path), Published(), tmp_path)
    assert any("unstable" in sentence for sentence in view.sentences)
    told = [cell.text for table in view.tables for row in table.cells for cell in row]
    assert not any("nan" in text.lower() for text in told)


def test_the_page_sets_published_errors_beside_ours(tmp_path):
    table, responses = staged(rows=trials(alpha=0.5))
    (tmp_path / STUDY).write_text(STUDY_TEXT.replace("NOISE", "0.0"))
    table.to_csv(tmp_path / STAGES, index=False)
    responses.to_csv(tmp_path / RESPONSES, index=False)
    with Store(tmp_path):
        pass
    columns = {"record": ["static-sine"], "pso_error": [0.777], "pso_rmse": [0.555]}
    printed = check_published({"tables": {"table_4": {"title": "Table 4", "columns": columns}}})
    (view,) = stage_views(read_results(tmp_path), printed, tmp_path)
    largest = next(each for each in view.tables if "F_error" in each.caption)
    row = next(row for row in largest.cells if row[0].text == "static-sine")
    assert row[1].text == "0.777"
    ours = table[(table["quantity"] == LARGEST) & (table["name"] == "static-sine") & (table["way"] == STAGED)]
    assert float(row[2].text) == pytest.approx(ours["value"].iloc[0], rel=1e-3)
    assert [picture.name for picture in view.fits] == ["stage-1-fit-1"]


def test_all_faults_of_a_stage_at_once(tmp_path):
    text = STUDY_TEXT.replace("NOISE", "0.0")
    changes = [
        ('after = "static"', 'after = "statc"'),
        ('optimizers = ["pso"]', 'optimizers = ["psoo"]'),
        ('"c_over_m"', '"c_over_n"'),
        ('beside = "together"', 'besides = "together"'),
    ]
    for change in changes:
        text = text.replace(*change)
    (tmp_path / "study.toml").write_text(text)
    with pytest.raises(UserError) as error:
        read_study(tmp_path / "study.toml")
    told = " ".join(error.value.faults)
    for part in (
        'after: no problem "statc"',
        'Did you mean "static"',
        'no optimizer "psoo"',
        'hammerstein has no parameter "c_over_n"',
        'Did you mean "c_over_m"',
        'no key "besides"',
        'Did you mean "beside"',
    ):
        assert part in told, part


@pytest.mark.parametrize(
    ("change", "part"),
    [
        (('fitted = ["sweep"]\ncheck', 'fitted = ["sweeep"]\ncheck'), 'Did you mean "sweep"'),
        (('fit = ["b", "c_over_m", "k_over_m"]', 'fit = ["k_over_m", "c_over_m", "b"]'), "in the model's order"),
        (('fit = ["b", "c_over_m", "k_over_m"]', 'fit = ["d", "b", "c_over_m"]'), "k_over_m of hammerstein is neither"),
        (('beside = "together"', 'control = ["ga"]'), '"ga" is not among the optimizers of this stage'),
        (
            ('optimizers = ["pso"]\nmodel = "hammer', 'optimizers = ["pso"]\nmodel = "hamer'),
            'Did you mean "hammerstein"',
        ),
    ],
)
def test_single_faults_of_a_stage(change, part):
    text = STUDY_TEXT.replace("NOISE", "0.0").replace(*change)
    with pytest.raises(UserError) as error:
        check_study(tomllib.loads(text), "t")
    assert part in " ".join(error.value.faults)
