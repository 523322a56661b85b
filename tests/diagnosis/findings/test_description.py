"""Accepted terms: the same numbers as the equation that they come from; in a model, and back from its file."""

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench.commands.data.journal import Journal
from hysteresis_bench.commands.diagnose import diagnose as command
from hysteresis_bench.data.data_files import write_csv
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.findings.description import Description, accepted
from hysteresis_bench.diagnosis.findings.diagnosis_file import write_diagnosis
from hysteresis_bench.diagnosis.findings.terms import Equation, FittedTerm, Term
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.fit.model_file import read_model
from hysteresis_bench.signals import Dataset, Record
from tests.diagnosis.generator import make

pytestmark = pytest.mark.usefixtures("few_laws")

TIME = 3.0 + np.linspace(0.0, 2.0, 300)
DRIVE = 1.0 + 2.0 * np.sin(2 * np.pi * 1.3 * TIME)
RECORD = Record(TIME, DRIVE, None)
SWARM = DRIVE[:, None] * np.array([0.5, 1.0, -2.0]) + np.array([0.0, 1.0, 3.0])


def equation_of(*kinds, value=0.3):
    terms = [Term(kind, value if kind in ("play", "lag", "log time") else 0.0, 1.0, 0.01) for kind in kinds]
    parts = [FittedTerm(term, 0.2 + 0.3 * k, 0.01, "1", 0.5 - k, 1e-9) for k, term in enumerate(terms)]
    return Equation(tuple(parts), 0.8)


@pytest.mark.parametrize(
    "kinds",
    [("u2",), ("branch", "play", "last"), ("y",), ("y2", "u3"), ("time",), ("rate", "lag", "log time"), ("cycle u",)],
    ids=" ".join,
)
@pytest.mark.parametrize("columns", [slice(1, 2), slice(None)], ids=["one", "swarm"])
def test_adds_what_its_equation_says(kinds, columns):
    equation, outputs = equation_of(*kinds), SWARM[:, columns]
    expected = np.column_stack([one + equation.evaluate(RECORD, one) for one in outputs.T])
    found = accepted(equation).apply(lambda signal: outputs, RECORD.signal, None)
    assert np.allclose(found, expected, rtol=0, atol=1e-12)


def test_terms_in_closed_form():
    """Means -0.5, -1.5, ...: 0.5 less one a term; time counts from the record's first sample."""
    found = accepted(equation_of("u2", "time", "y2")).apply(lambda signal: SWARM, RECORD.signal, None)
    u, t = (DRIVE - 1.0)[:, None], (TIME - 3.0)[:, None]
    assert np.allclose(found - SWARM, 0.2 * (u**2 - 0.5) + 0.5 * (t + 0.5) + 0.8 * (SWARM**2 + 1.5))


def test_no_terms_change_nothing():
    assert Description().apply(lambda signal: SWARM, RECORD.signal, None) is SWARM
    assert accepted(Equation((), 0.0)) == Description()


@pytest.mark.parametrize("wrong", [{"mean": None}, {"power": 2}], ids=["missing", "unknown"])
def test_wrong_fields_are_told(wrong):
    (term,) = accepted(equation_of("u")).terms
    fields = {key: value for key, value in {**term, **wrong}.items() if value is not None}
    with pytest.raises(ValueError, match="term 2 must have"):
        Description((term, fields))


@pytest.fixture(scope="module")
def odd():
    """A loop with a step at every reversal, which no effect has; every other sample of three records."""
    made = make(1, "bouc-wen", hidden=(), noise=0.002).dataset
    records = []
    for record in made.records:
        if record.name in ("fit-1", "fit-2", "held-1"):
            step = 0.05 * np.ptp(record.output) * np.sign(np.gradient(record.input))
            records.append(replace(record, output=record.output + step).take(slice(None, None, 2)))
    return Dataset(tuple(records), ("held-1",))


@pytest.fixture(scope="module")
def fits(tmp_path_factory):
    """The same with and without terms: made once."""
    return Journal(tmp_path_factory.mktemp("kept") / "fits", "of one loop")


def asked(accept_terms: bool, fits: Journal) -> Question:
    """The step turns the loop's sense, and a clockwise Bouc-Wen can bend to it: its hysteresis stays anticlockwise."""
    options = DiagnosisOptions(jobs=1, accept_terms=accept_terms, kept=fits)
    return Question(
        "bouc-wen", among=("backlash", "creep", "output-lag"), bounds={"alpha": (0.0, 2.0)}, options=options
    )


@pytest.fixture(scope="module")
def described(odd, fits, names_only):
    with names_only():
        return diagnose(odd, asked(accept_terms=True, fits=fits))


@pytest.mark.long
def test_accepted_terms_bring_the_error_down(odd, described, fits, names_only):
    with names_only():
        plain = diagnose(odd, asked(accept_terms=False, fits=fits))
    assert "description" not in plain.effects
    assert any(part.term.kind == "branch" for part in plain.equation.terms)
    assert described.effects == (*plain.effects, "description")
    assert described.after.fitted.rmse < 0.7 * plain.after.fitted.rmse
    assert described.after.held_out.rmse < 0.7 * plain.after.held_out.rmse
    row = next(row for row in described.candidates if row.effect == "description")
    assert row.adopted
    assert row.parameters["sign(du/dt)"] == pytest.approx(0.05 * np.ptp(odd.records[0].output), rel=0.4)


def test_the_written_model_predicts_what_was_found(odd, described, tmp_path):
    write_diagnosis(tmp_path, described)
    predicted = read_model(tmp_path / "model.json").predict(odd)
    for record, before in zip(predicted.records, odd.records, strict=True):
        simulated = described.after.problem.system.respond(before, described.after.values[:, None])[:, 0]
        assert np.allclose(record.output, simulated, rtol=0, atol=1e-9)
    error = predicted.held_out[0].output - odd.held_out[0].output
    assert np.sqrt(np.mean(error**2)) == pytest.approx(described.after.held_out.rmse)


def test_the_command_passes_it_on(odd, described, tmp_path, monkeypatch):
    asked = {}

    def found(dataset, question):
        asked["question"] = question
        return described

    monkeypatch.setattr("hysteresis_bench.diagnosis.diagnose.diagnose", found)
    write_csv(tmp_path / "one.csv", Dataset(odd.records[:1]))
    told = [str(tmp_path / "one.csv"), "--model", "bouc-wen", "--out", str(tmp_path / "out"), "--accept-terms"]
    ran = CliRunner().invoke(command, told)
    assert ran.exit_code == 0, ran.output
    assert asked["question"].options.accept_terms is True
    effects = json.loads((tmp_path / "out" / "diagnosis.json").read_text())["effects"]
    assert "description" in effects
    assert "description" in (tmp_path / "out" / "diagnosis.html").read_text()
