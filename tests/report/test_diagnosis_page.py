"""The page of a diagnosis: everything that was found is on it, and nothing that was not."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench.diagnosis.ceiling.ceiling import Ceiling
from hysteresis_bench.diagnosis.evidence.memory import Memory
from hysteresis_bench.diagnosis.evidence.noise import Noise
from hysteresis_bench.diagnosis.evidence.residual_tests import ResidualTest
from hysteresis_bench.diagnosis.experiments.settled import Measured, Tied
from hysteresis_bench.diagnosis.findings.advice import Advice
from hysteresis_bench.diagnosis.findings.diagnosis_file import DIAGNOSIS, DRAWN, RESPONSES, as_dict, write_diagnosis
from hysteresis_bench.diagnosis.findings.result import Candidate, Diagnosis, Stage
from hysteresis_bench.diagnosis.findings.ties import tie
from hysteresis_bench.diagnosis.laws.comparison import BASELINE
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.accuracy import Accuracy
from hysteresis_bench.fit.model_file import Estimate, FittedModel
from hysteresis_bench.report.diagnosis.before_after import bars_from
from hysteresis_bench.report.diagnosis.figures import WITHOUT, Bar, bars_of, draw_residual, residuals, waterfall
from hysteresis_bench.report.diagnosis.for_papers import draw_diagnosis
from hysteresis_bench.report.diagnosis.in_print import first_sentence, in_print
from hysteresis_bench.report.diagnosis.page import RECORDS_DRAWN, write_diagnosis_page
from hysteresis_bench.signals import Record

UNITS = {"time": "s", "input": "V", "output": "um"}


def _stage(names: tuple[str, ...], rmse: float, p: float) -> Stage:
    tests = tuple(
        ResidualTest(record, "rate", 3.0, p, p, 0.4, f"the residual depends on the input's rate, p = {p:.2g}")
        for record in ("all", "slow", "fast")
    )
    return Stage(names, None, np.zeros(0), Accuracy(rmse, rmse / 10, 0.3), Accuracy(2 * rmse, rmse / 5, 0.4), tests)  # type: ignore[arg-type]


@pytest.fixture
def diagnosis() -> Diagnosis:
    time = np.linspace(0.0, 1.0, 400)
    parts = []
    for record, role in (("slow", "fitted"), ("fast", "fitted"), ("other", "held-out")):
        u = np.sin(6.0 * time)
        part = {"time": time, "input": u, "output": u, "before": 0.8 * u, "after": 0.99 * u}
        parts.append(pd.DataFrame({"record": record, "role": role, **part}))
    parameters = {"d": Estimate(1.0, 0.1, "um/V"), "input-lag.time_constant": Estimate(0.0123, 0.0004, "s")}
    one = tie("input-lag", "transport-delay", 0.001)
    return Diagnosis(
        model_name="bouc-wen",
        verdict="effect-found",
        headline="The model lacks input-lag: the RMSE falls from 0.6 to 0.04 um; the noise is 0.02.",
        effects=("input-lag",),
        offset="",
        before=_stage((), 0.3, 1e-9),
        after=_stage(("input-lag",), 0.02, 0.5),
        noise=Noise(0.02, 0.001, 0.0, 0.0, None, (0.02,), 0.0, 800),
        floor=0.02,
        candidates=(
            Candidate("input-lag", True, "", True, 0.02, 0.021, 1e-12, 9.0, {"time_constant": 0.0123}, (), ("a",)),
            Candidate("transport-delay", True, "", False, 0.02, 0.021, 0.4, 0.1, {"delay": 0.01}, (), ("input-lag",)),
            Candidate("drift", True, "", False, 0.02, 0.02, 0.7, 0.0, {"rate": 0.0}, ("drift.rate",)),
            Candidate("temperature-sensitivity", False, "no column temperature <here>"),
        ),
        steps=(),
        waterfall=(("bouc-wen alone", 0.3), ("input-lag", 0.02), ("noise", 0.02)),
        ties=(one,),
        advice=Advice("a sine of 5 Hz", 0.2, 0.02, "Measure a sine of 5 Hz: that settles it."),
        memory=Memory(True, 1e-5, 1.0, 1.0, 0.1, 0.2, "curve", (0.0,), False, "hysteresis is needed"),
        equation=None,
        model=FittedModel("bouc-wen", {}, ("input-lag",), {}, UNITS, parameters, created_by={"hysteresis-bench": "1"}),
        responses=pd.concat(parts, ignore_index=True),
        split={"fitted": ["slow", "fast"], "held_out": ["other"], "how": "held out as asked"},
        warnings=("One thing to know.", f"input-lag and transport-delay cannot be told apart: {one.reason}."),
        units=UNITS,
        given_up=None,
        unseen=0.02,
    )


def _written(folder: Path, diagnosis: Diagnosis) -> str:
    write_diagnosis(folder, diagnosis)
    return write_diagnosis_page(folder).read_text(encoding="utf-8")


def _plain(page: str) -> str:
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", page[page.index("<main>") :]))


def test_the_page_says_what_was_found(tmp_path, diagnosis):
    text = _plain(_written(tmp_path, diagnosis))
    assert text.index(in_print(diagnosis.headline)) < text.index("before and after")
    for words in (
        "bouc-wen lacks input-lag",
        "input-lag or, as well, transport-delay",
        diagnosis.advice.words,
        "input-lag.time_constant 0.0123",
        "a delay both only shift the loop",
        "held out as asked",
        "rate 0 (at its bound)",
    ):
        assert words in text, words
    assert "d 1 0.1" not in text  # the model's own parameters are not the diagnosis
    assert text.count("cannot be told apart") == 0  # the ties are told once, in their own list


def test_the_page_stands_alone_and_escapes(tmp_path, diagnosis):
    page = _written(tmp_path, diagnosis)
    assert "no column temperature &lt;here&gt;" in page
    assert not re.search(r'(src|href)="https?:', page)
    assert "prefers-color-scheme: dark" in page
    assert {path.name for path in (tmp_path / "figures").iterdir()} >= {"waterfall.svg", "loop-1-other-before.svg"}
    identifiers = re.findall(r'\bid="([^"]+)"', page)
    assert len(identifiers) == len(set(identifiers))


def test_a_figure_for_a_paper(tmp_path, diagnosis):
    write_diagnosis(tmp_path, diagnosis)
    draw_diagnosis(tmp_path / "d.svg", tmp_path)
    drawn = (tmp_path / "d.svg").read_text(encoding="utf-8")
    for words in ("+ input-lag", "noise in the data", "RMSE (μm)", "other (held-out)", "Input (V)", "Time (s)"):
        assert words in drawn, words
    before, after = (replace(stage, held_out=None) for stage in (diagnosis.before, diagnosis.after))
    fitted = diagnosis.responses[diagnosis.responses["role"] == "fitted"]
    write_diagnosis(tmp_path, replace(diagnosis, before=before, after=after, responses=fitted))
    draw_diagnosis(tmp_path / "d.svg", tmp_path)
    drawn = (tmp_path / "d.svg").read_text(encoding="utf-8")
    assert "slow (fitted)" in drawn
    assert "not fitted" not in drawn


def test_nothing_missing_is_told_without_advice_or_added_parameters(tmp_path, diagnosis):
    nothing = replace(
        diagnosis,
        verdict="no-effect-needed",
        headline="No effect that is known here is missing.",
        effects=(),
        after=diagnosis.before,
        ties=(),
        advice=None,
        candidates=diagnosis.candidates[2:],
        waterfall=(("bouc-wen alone", 0.3), ("noise", 0.02)),
        warnings=(),
    )
    text = _plain(_written(tmp_path, nothing))
    assert "bouc-wen lacks nothing known here" in text
    for heading in ("What to measure next", "Parameters that came with", "cannot tell apart", "Before you believe it"):
        assert heading not in text, heading


def test_what_is_left_is_in_the_title(tmp_path, diagnosis):
    left = replace(diagnosis, verdict="unexplained-residual")
    assert "input-lag or its like, and something without a name" in _plain(_written(tmp_path, left))
    unnamed = replace(left, effects=(), ties=())
    assert "leaves something that no effect explains" in _plain(_written(tmp_path, unnamed))


def test_without_held_out_records_or_noise(tmp_path, diagnosis):
    before, after = (replace(stage, held_out=None) for stage in (diagnosis.before, diagnosis.after))
    steps = (("bouc-wen alone", 0.3), ("input-lag", 0.0), ("noise", 0.0))
    after = replace(after, fitted=Accuracy(0.0, 0.0, 0.0))
    text = _plain(_written(tmp_path, replace(diagnosis, before=before, after=after, floor=0.0, waterfall=steps)))
    assert "held out, before" not in text


def test_many_records_are_told_and_some_drawn(tmp_path, diagnosis):
    one = diagnosis.responses[diagnosis.responses["record"] == "slow"]
    many = pd.concat([one.assign(record=f"r{number}") for number in range(9)] + [diagnosis.responses])
    page = _written(tmp_path, replace(diagnosis, responses=many))
    assert f"{12 - RECORDS_DRAWN} more records are not drawn" in page
    assert "other (held-out)" in page
    assert len(list((tmp_path / "figures").glob("loop-*-after.svg"))) == RECORDS_DRAWN


def test_the_page_of_an_older_diagnosis_shows_what_its_files_have(tmp_path, diagnosis):
    _written(tmp_path, diagnosis)
    content = json.loads((tmp_path / DIAGNOSIS).read_text())
    for key in ("floor", "doubtful", "described", "offset_of_both", "equation", "experiment", "given_up"):
        del content[key]
    for candidate in content["candidates"]:
        del candidate["judgement"]
    (tmp_path / DIAGNOSIS).write_text(json.dumps(content))
    responses = pd.read_csv(tmp_path / RESPONSES)
    responses[responses["role"] == "held-out"].to_csv(tmp_path / RESPONSES, index=False)
    text = _plain(write_diagnosis_page(tmp_path).read_text(encoding="utf-8"))
    assert "bouc-wen lacks input-lag or its like" in text
    assert "input-lag adopted" in text
    assert "transport-delay tied" in text
    assert "other (held-out)" in text
    assert "2 more records are not drawn" in text


def test_a_folder_without_a_diagnosis_is_the_users_fault(tmp_path):
    with pytest.raises(UserError, match=r"diagnosis\.json"):
        write_diagnosis_page(tmp_path)


def test_what_only_describes_is_not_named_in_the_title(tmp_path, diagnosis):
    model = replace(diagnosis.model, effects=("input-lag", "description"))
    described = replace(diagnosis, effects=("input-lag", "description"), ties=(), model=model)
    assert "bouc-wen lacks input-lag " in _plain(_written(tmp_path, described))


def test_a_long_record_is_kept_as_finely_as_a_figure_shows(tmp_path, diagnosis):
    one = diagnosis.responses[diagnosis.responses["record"] == "slow"]
    long = pd.concat([one] * 20, ignore_index=True)
    _written(tmp_path, replace(diagnosis, responses=long))
    kept = pd.read_csv(tmp_path / RESPONSES)
    assert len(kept) == DRAWN
    assert kept["time"].iloc[-1] == long["time"].iloc[-1]


def test_what_nothing_was_added_to_is_drawn_once(tmp_path, diagnosis):
    same = diagnosis.responses.assign(before=diagnosis.responses["after"])
    page = _written(tmp_path, replace(diagnosis, responses=same))
    assert "loop-1-other-before" not in page
    assert "Measured and simulated." in page


def test_law_and_effects_are_one_waterfall_where_the_law_was_sought(diagnosis):
    found = as_dict(diagnosis)
    bars = [(bar.label, bar.fitted, bar.unseen) for bar in bars_from(found)]
    assert bars == [
        ("bouc-wen alone", 0.3, 0.6),
        ("+ input-lag", 0.02, 0.04),
        ("noise in the data", 0.02, None),
    ]
    laws = [{"law": "bouc-wen", "fitted": 0.3, "held_out": 0.6}, {"law": BASELINE, "fitted": 2.0, "held_out": 2.2}]
    sought = bars_from({**found, "laws": {"laws": laws}})
    assert [(bar.label, bar.fitted, bar.unseen) for bar in sought] == [(BASELINE, 2.0, 2.2), *bars]


def test_a_polynomial_far_above_does_not_hide_the_effects(tmp_path):
    bars = bars_of([("law alone", 0.3), ("lag", 0.1), ("noise", 0.02)], (None, None))
    far, near = (waterfall(tmp_path, [Bar("none", rmse, WITHOUT), *bars], units={}) for rmse in (9.0, 0.5))
    assert "The bar with an arrow goes on" in far.caption
    assert "without memory" in near.caption
    assert "arrow" not in near.caption
    assert "Dashed: the noise in the data." in near.caption
    assert ">9<" in far.inline


def test_what_a_black_box_reaches_stands_beside_the_verdict(tmp_path, diagnosis):
    reached = Ceiling(0.13, 0.1, 0.11, 4.0, "past extrema", "whole records", 4, "um", 0.09, 0.08, None)
    text = _plain(_written(tmp_path, replace(diagnosis, ceiling=reached)))
    told = [text.index(in_print(words)) for words in (diagnosis.headline, reached.words)]
    assert told == sorted(told)
    assert told[-1] < text.index("before and after")


def test_a_diagnosis_of_before_the_ceiling_has_its_page(tmp_path, diagnosis):
    write_diagnosis(tmp_path, diagnosis)
    content = json.loads((tmp_path / DIAGNOSIS).read_text(encoding="utf-8"))
    del content["ceiling"]
    (tmp_path / DIAGNOSIS).write_text(json.dumps(content), encoding="utf-8")
    assert "black box" not in write_diagnosis_page(tmp_path).read_text(encoding="utf-8")


def test_what_was_measured_and_what_it_settled(tmp_path, diagnosis):
    lags = Tied(("input-lag", "transport-delay", "creep"), 0.93, (("input-lag",),))
    record = Record(np.arange(120.0), np.zeros(120), None, "advised-pea")
    notes = ("The rig could not follow.",)
    told = Measured("pea", "a sine of 5 Hz", record, "It lacked a lag.", ("input-lag",), (lags,), notes)
    text = _plain(_written(tmp_path, replace(diagnosis, measured=told)))
    for words in (
        "carried out on pea: a sine of 5 Hz (120 samples, record advised-pea)",
        "Tied before were input-lag, transport-delay or creep: it is input-lag.",
        "Before: It lacked a lag.",
        "input-lag, transport-delay and creep 93 % it is input-lag",
        *notes,
    ):
        assert words in text, words
    kept = json.loads((tmp_path / "diagnosis.json").read_text(encoding="utf-8"))
    assert kept["measured"]["ties"][0]["settled"]
    assert kept["measured"]["before"]["effects"] == ["input-lag"]
    assert "carried out" not in _plain(_written(tmp_path, diagnosis))


@pytest.mark.parametrize(
    ("words", "printed"),
    [
        ("falls from 2.62e-05 to 1.02e+03 C/m^2; so.", "falls from 2.62×10⁻⁵ to 1\u202f020 C/m²; so."),
        ("leaves 4.13% of the range (p = 2.8e-204)", "leaves 4.13\u202f% of the range (p < 0.001)"),
        ("drifts by 0.3 um/s (13 % of it), p = 0.", "drifts by 0.3 μm/s (13\u202f% of it), p < 0.001."),
        ("p = 0.023, of 3 degC or 1e-06 um", "p = 0.023, of 3 °C or 1×10⁻⁶ μm"),
        ("record file-2e-5.csv of um", "record file-2e-5.csv of um"),
    ],
)
def test_sentences_are_printed_as_the_tables_are(words, printed):
    assert in_print(words) == printed


def test_only_the_first_sentence_of_the_verdict_is_strong(tmp_path, diagnosis):
    headline = "The model lacks input-lag: it falls to 0.04 um. dahl alone does not. Something is left."
    page = _written(tmp_path, replace(diagnosis, headline=headline))
    assert '<p class="strong">The model lacks input-lag: it falls to 0.04 μm.</p>' in page
    assert "<p>dahl alone does not. Something is left.</p>" in page
    assert first_sentence("One only.") == ("One only.", "")


def test_what_the_data_do_not_determine_is_no_result(tmp_path, diagnosis):
    def text_with(error: float | None) -> str:
        parameters = {"d": Estimate(1.0, 0.1, "um/V"), "input-lag.time_constant": Estimate(0.0123, error, "s")}
        return _plain(_written(tmp_path, replace(diagnosis, model=replace(diagnosis.model, parameters=parameters))))

    for unsure in (None, 0.02):
        text = text_with(unsure)
        assert "time_constant 0.0123 (not determined)" in text
        assert "these data do not tell the value of input-lag.time_constant: it is no result" in text
    sure = text_with(0.0004)
    assert "not determined" not in sure
    assert "it is no result" not in sure


def test_errors_have_one_sign_and_a_band_that_can_be_seen(tmp_path, diagnosis):
    rows = diagnosis.responses[diagnosis.responses["record"] == "slow"]
    told = {"units": UNITS, "caption": "slow."}
    seen, thin = (residuals(tmp_path, "r", rows, noise=noise, **told)[0].caption for noise in (0.02, 1e-5))
    assert seen == "slow. Simulated minus measured over time; shaded: twice the noise to either side."
    assert "would be thinner than a line" in thin
    lines = []
    axes = Mock(plot=lambda x, y, **_: lines.append(np.asarray(y)))
    draw_residual(axes, rows, "time", 0.02, UNITS)
    assert lines[0] == pytest.approx((rows["before"] - rows["output"]).to_numpy())
