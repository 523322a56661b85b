"""The page on real measurements: one noise in both tables, what is counted, and what stands in for a law."""

from __future__ import annotations

import json
import re
from types import ModuleType

import pandas as pd
import pytest

from benchmarks import measured_page
from hysteresis_bench.report.diagnosis.in_print import unit_in_print
from tests.conftest import ROOT

LAWS = pd.DataFrame(
    [
        {"device": "steel", "unit": "T", "held_out": 0.3001, "ratio": 0.3001, "asked": 0.4, "law": "dahl"},
        {"device": "film", "unit": "C/m^2", "held_out": 0.2, "ratio": 0.2, "asked": 0.1, "law": "dahl"},
        {"device": "made (synthetic)", "unit": "m", "held_out": 0.1, "ratio": 0.1, "asked": 0.2, "law": "lugre"},
    ]
).assign(run="yes", compared=2, repeats="well", effects="drift", polynomial=1.0, floor=9.0, range=2.0)

FOUND = pd.DataFrame(
    [
        {"device": "steel", "floor": 0.01, "effects": "creep", "unit": "T"},
        {"device": "made (synthetic)", "floor": 0.15, "effects": "", "unit": "m"},
    ]
).assign(law="dahl", stand_ins="bias", before=0.2, after=0.1, constant=0.0, seconds=60, headline="", verdict="")

CASE = {
    "case": "Mn-Zn ferrite",
    "model": "dahl",
    "effects": "",
    "ties": "",
    "hysteresis_needed": "True",
    "hysteresis": "branches explain 4.13% (p = 0)",
    "noise": "0.001",
    "held_out_before": "0.00665",
    "held_out_after": "0.00889",
    "unit": "T",
    "parameters": json.dumps({"bias.level": [-2.0, 6484.0, "um"], "lag.time": [1.0, None, "s"]}),
    "advice": "",
    "headline": "No effect is named: it is 0.00889 T. dahl alone does not.",
}
STEPS = [
    {"case": "Mn-Zn ferrite", "step": step, "rmse": rmse}
    for step, rmse in (("dahl with a bias", "0.3"), ("input-curve (stand-in)", "0.2"), ("noise", "0.1"))
]


@pytest.fixture
def measurements(monkeypatch) -> ModuleType:
    """benchmarks/real_measurements.py, which is run from its folder."""
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    return __import__("real_measurements")


def cells(table) -> dict[str, list[str]]:
    return {row[0].text: [cell.text for cell in row[1:]] for row in table.cells}


def test_the_noise_is_the_diagnosis_s_and_marked_where_it_cannot_be(tmp_path):
    rows = cells(measured_page.section(tmp_path, LAWS, {"steel": 0.01, "made (synthetic)": 0.15}).blocks[0])
    assert rows["steel, T"][-1] == "0.01"
    assert rows["made (synthetic, not counted), m"][-1] == "0.15 (too high)"
    assert rows["film, C/m²"][-1] == "–"
    assert [rows["steel, T"][0], rows["film, C/m²"][0]] == ["0.3001", "0.2"]


def test_the_answer_says_early_that_it_is_no_blind_test():
    first, second, *_ = measured_page.answer(LAWS)
    assert first.startswith("On 1 of 2 questions to measured devices")
    assert second.startswith("This is no blind test")
    assert measured_page.KNOWN in second


def test_a_number_beside_its_goal_has_digits_enough():
    assert [measured_page.beside(value, 0.3) for value in (0.2, 0.3001, 0.29996, 0.30000001)] == [
        "0.2",
        "0.3001",
        "0.29996",
        "0.300000",
    ]


def test_the_page_counts_what_was_measured_and_leads_to_its_parts(tmp_path, measurements):
    LAWS.to_csv(tmp_path / measurements.LAWS, index=False)
    FOUND.to_csv(tmp_path / measurements.FOUND, index=False)
    page = measurements.page(tmp_path, [CASE], STEPS).read_text(encoding="utf-8")
    assert "In 1 of 1 an effect is named" in page
    assert "made (synthetic), not counted above: the law is dahl, no effect is named" in page
    links = re.findall(r'<li><a href="#([^"]+)"', page)
    assert links
    assert all(f'id="{link}"' in page for link in links)
    assert '<p class="strong">No effect is named: it is 0.00889 T.</p>' in page
    assert "Branches explain 4.13\u202f% (p &lt; 0.001)." in page


def test_a_noise_that_cannot_be_is_marked_where_no_law_was_given(measurements):
    rows = cells(measurements.diagnosed_page.section(FOUND, LAWS).blocks[1])
    assert [row[-1] for row in rows.values()] == ["0.01", "0.15 (too high)"]


def test_what_stands_in_for_the_law_and_what_made_it_worse_is_seen(measurements):
    (row,) = measurements._summary([CASE], STEPS).cells
    assert [cell.text for cell in row[2:4]] == ["none", "input-curve and bias"]
    assert (row[7].text, row[7].tone) == ("0.748", "bad")
    assert measurements.stand_ins({**CASE, "stand_ins": "creep drift"}, STEPS) == ["creep", "drift"]
    assert measurements.stand_ins({**CASE, "case": "other"}, STEPS) == []


def test_a_parameter_that_the_data_do_not_determine_is_red(measurements):
    rows = {row[0].text: row for row in measurements._parameters(CASE).cells}
    assert (rows["bias.level"][3].tone, rows["bias.level"][4].text) == ("bad", "μm")
    assert rows["lag.time"][2].text == "not determined"


def test_older_rows_are_kept_beside_newer_ones(tmp_path, measurements):
    measurements.write(tmp_path / "n.csv", [{"case": "a"}, {"case": "b", "stand_ins": "creep"}])
    assert measurements.read(tmp_path / "n.csv") == [
        {"case": "a", "stand_ins": ""},
        {"case": "b", "stand_ins": "creep"},
    ]


def test_units_are_printed_as_quantities_are():
    assert [unit_in_print(unit) for unit in ("C/m^2", "um/s", "A m^2", "1/s", "degC")] == [
        "C/m²",
        "μm/s",
        "A m²",
        "1/s",
        "°C",
    ]
