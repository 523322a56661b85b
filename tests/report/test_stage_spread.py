"""The tables of a stage over its trials: a median over instances, the paper's numbers beside it."""

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.report.paper.published import Published, check_published
from hysteresis_bench.report.stages.spread import spread_tables, tuned_table
from hysteresis_bench.study.afterwards.staged_trials import TUNED
from hysteresis_bench.study.study_file import StageSpec

SPEC = StageSpec(
    name="linear", after="static", optimizers=["gpmix", "ga"], model="hammerstein",
    fit=("b", "c_over_m", "k_over_m"), fitted=["sweep"], check=["slow", "fast"], control=["gpmix"],
    controllers=["sliding-mode-printed"],
)  # fmt: skip
PUBLISHED = check_published(
    {
        "tables": {
            "table_3": {"title": "3", "columns": {"optimizer": ["ga"], "b": [9], "c_over_m": [8], "k_over_m": [7]}},
            "table_4": {"title": "4", "columns": {"record": ["fast", "slow"], "gpmix_rmse": [0.3, 0.1]}},
            "table_6": {
                "title": "6",
                "controller": "sliding-mode-printed",
                "columns": {"reference": ["ramp"], "gpmix_rmse": [0.01]},
            },
        }
    }
)


def staged(instances=3):
    keys = [(label, i, t) for label in SPEC.optimizers for i in range(1, instances + 1) for t in (0, 1)]
    table = pd.DataFrame(keys, columns=["optimizer", "instance", "trial"]).assign(stage="linear", fault="")
    size = table["instance"] + np.where(table["optimizer"] == "ga", 10, 0)
    table = table.assign(b=size, c_over_m=size, k_over_m=size)
    checks = {f"check_rmse{record}": size / 100 for record in ("", ".slow", ".fast")}
    loops = {f"tracking_rmse.sliding-mode-printed{signal}": size / 1000 for signal in ("", ".ramp")}
    return table.assign(**checks, **loops)


def rows(table):
    return {row[0].text: [cell.text for cell in row[1:]] for row in table.cells}


def test_a_row_is_the_median_over_instances_beside_what_is_printed():
    section, check, loop = spread_tables(SPEC, staged(), PUBLISHED, "um")
    assert section.caption.endswith("over 3 instances, 6 trials")
    assert section.header == ["Quantity", "gpmix", "ga, published", "ga, ours"]
    assert rows(section)["b"] == ["2 (1.5 to 2.5)", "9", "12 (11.5 to 12.5)"]
    assert list(rows(check)) == ["slow", "fast", "mean"]
    assert rows(check)["slow"] == ["0.1", "0.02 (0.015 to 0.025)", "0.12 (0.115 to 0.125)"]
    assert rows(check)["mean"][0] == "0.2"
    assert loop.header == ["Quantity", "gpmix, published", "gpmix, ours"]
    assert rows(loop)["ramp"] == ["0.01", "0.002 (0.0015 to 0.0025)"]
    assert all(section.numeric[1:])


def test_a_stage_without_a_check_has_no_table_of_it():
    """Its columns are there where another stage of the study has one, and are empty."""
    table = staged().assign(**{f"check_rmse{record}": np.nan for record in ("", ".slow", ".fast")})
    captions = [table.caption for table in spread_tables(SPEC.model_copy(update={"check": []}), table, PUBLISHED, "um")]
    assert not any("F_rmse" in caption for caption in captions)
    assert len(captions) == 2


def test_a_median_lies_between_its_quartiles_as_they_are_told():
    table = staged().assign(b=lambda rows: 499.8 + 1e-3 * rows["instance"])
    section, *_ = spread_tables(SPEC, table, Published(), "um")
    assert rows(section)["b"][0] == "499.8 (499.8 to 499.8)"


@pytest.mark.parametrize("share", [0.4, 0.6])
def test_a_section_that_cannot_be_used_counts_as_the_worst(share):
    table = staged(5)
    table.loc[table["instance"] <= 5 * share, ["check_rmse", "check_rmse.slow"]] = np.nan
    _, check, _ = spread_tables(SPEC, table, Published(), "um")
    assert rows(check)["slow"][0].startswith("failed" if share > 0.5 else "0.05")


def test_the_tuned_constants_stand_beside_the_printed_ones():
    columns = {"parameter": ["C", "epsilon", "rho", "d"], "value": [0.3, 0.6, 0.5, 1.0]}
    published = check_published({"tables": {"table_5": {"title": "5", "columns": columns}}})
    table = staged()
    tuned = table.assign(**{name: table["instance"] for name in TUNED.values()})
    found = tuned_table(SPEC, tuned, published)
    assert found.header == ["Quantity", "gpmix, published", "gpmix, ours"]
    assert rows(found) == {
        name: [value, "2 (1.5 to 2.5)"]
        for name, value in zip(("C", "epsilon", "rho"), ("0.3", "0.6", "0.5"), strict=True)
    }
    one = tuned_table(SPEC, tuned.query("instance == 1 and trial == 0"), Published())
    assert rows(one)["rho"] == ["1"]
    assert tuned_table(SPEC, table, published) is None
    assert tuned_table(SPEC.model_copy(update={"control": []}), tuned, published) is None


def test_one_trial_has_no_spread():
    assert spread_tables(SPEC, staged(1).query("trial == 0"), PUBLISHED, "um") == []
