"""The page of a fit: how good it is, in words, numbers and figures."""

import re

import numpy as np
import pandas as pd

from hysteresis_bench import registry
from hysteresis_bench.report.fit.page import write_fit_page
from tests.report.links import parsed

FIT = {
    "title": "A <fit>",
    "model": "jiles-atherton",
    "effects": ["bias"],
    "units": {"time": "s", "input": "A/m", "output": "T"},
    "parameters": [
        {"name": "a", "value": 31.2, "standard_error": 0.4, "unit": "A/m", "at_bound": False},
        {"name": "k", "value": 9.1, "standard_error": None, "unit": "A/m", "at_bound": True},
    ],
    "records": [
        {"record": "one/1", "role": "fitted", "rmse": 0.003, "relative_rms": 0.004, "max_error": 0.06},
        {"record": "two", "role": "held-out", "rmse": 0.03, "relative_rms": 0.2, "max_error": 0.3},
    ],
    "notes": ["a note"],
    "warnings": ["a warning"],
    "provenance": {"seed": 1, "versions": {"numpy": "2"}},
    "agreement": "Two searches agree.",
}


def fit_responses():
    time = np.arange(50.0)
    drive = np.sin(time)
    return pd.concat(
        pd.DataFrame(
            {"record": record, "role": role, "time": time, "input": drive, "output": drive, "simulated": 0.9 * drive}
        )
        for record, role in (("one/1", "fitted"), ("two", "held-out"))
    )


def test_the_page_of_a_fit_says_how_good_it_is(tmp_path):
    page = write_fit_page(tmp_path, FIT, fit_responses())
    html = page.read_text(encoding="utf-8")
    text = re.sub(r"<[^>]+>", " ", html)
    for wanted in (
        "very good",
        "poor",
        "Two searches agree.",
        "a warning",
        "a note",
        "31.2",
        "A/m",
    ):
        assert wanted in text
    assert "A &lt;fit&gt;" in html
    assert html.count("<figure>") == 4
    links = parsed(html)
    assert all((tmp_path / source).is_file() for source in links.sources if not source.startswith("#"))


def test_a_fit_without_held_out_records_says_so(tmp_path):
    fit = {**FIT, "records": FIT["records"][:1]}
    html = write_fit_page(tmp_path, fit, fit_responses()).read_text(encoding="utf-8")
    assert "No record was held out" in html


def test_the_largest_error_is_said_to_be_of_the_record_that_has_it(tmp_path):
    one, other = FIT["records"][0], {**FIT["records"][0], "record": "other", "relative_rms": 0.005, "max_error": 0.02}
    html = write_fit_page(tmp_path, {**FIT, "records": [one, other]}, fit_responses()).read_text(encoding="utf-8")
    assert "at worst (other) the model leaves a relative RMS of 0.5" in html
    assert "a largest error of 6\u202f% (in one/1)" in html


def test_a_command_between_backticks_is_set_as_code_and_nothing_else_is(tmp_path):
    warned = {**FIT, "warnings": ["5 < 6; `diagnose` looks for it."], "notes": ["one ` alone"]}
    html = write_fit_page(tmp_path, warned, fit_responses()).read_text(encoding="utf-8")
    assert "<li>5 &lt; 6; <code>diagnose</code> looks for it.</li>" in html
    assert "<li>one ` alone</li>" in html


def test_the_title_names_the_records_that_were_fitted_and_no_others(tmp_path):
    from hysteresis_bench.fit.fitting import FitOptions, fit_records
    from hysteresis_bench.report.fit.folder import write_fit
    from hysteresis_bench.signals import Dataset, Record

    time = np.linspace(0.0, 2.0, 60)
    drive = np.sin(7.0 * time)
    records = tuple(Record(time=time, input=drive, output=2.0 * drive, name=name) for name in ("seen", "unseen"))
    dataset = Dataset(records, ("unseen",))
    page = write_fit(tmp_path, fit_records(dataset, "dahl", options=FitOptions(budget=40)), [])
    assert "<h1>dahl fitted to seen</h1>" in page.read_text(encoding="utf-8")


def test_the_law_of_plays_shows_its_weights_and_another_its_everett_function(tmp_path):
    from hysteresis_bench.fit.model_file import Estimate, FittedModel
    from hysteresis_bench.report.laws.memory import memory_section

    units, ranges = {"time": "s", "input": "V", "output": "um"}, {"ranges": {"input": [-2.0, 3.0]}}
    inputs = [3.0 * np.sin(np.linspace(0.0, 20.0, 400))]

    def page(model):
        law = registry.build("models", model, {})
        estimates = {name: Estimate(value, None, "1") for name, value in law.example.parameters.items()}
        fitted = FittedModel(model, {}, (), {}, units, estimates, data=ranges)
        section = memory_section(tmp_path, fitted, inputs)
        html = write_fit_page(tmp_path, FIT, fit_responses(), section).read_text(encoding="utf-8")
        assert len(html) < 2e6
        links = parsed(html)
        assert all((tmp_path / source).is_file() for source in links.sources if not source.startswith("#"))
        return html

    html = page("prandtl-ishlinskii")
    assert "slope of each play" in html
    assert "μm/V" in html
    table = pd.read_csv(tmp_path / "density.csv")
    assert list(table) == ["threshold", "weight"]
    assert len(table) == 12
    html = page("bouc-wen")
    assert "A law without return-point memory and congruent loops does more than they tell." in html
    assert set(pd.read_csv(tmp_path / "everett.csv")["quantity"]) == {"everett", "density"}
    assert "What the law remembers" not in page_without_memory(tmp_path)


def page_without_memory(folder):
    return write_fit_page(folder, FIT, fit_responses()).read_text(encoding="utf-8")
