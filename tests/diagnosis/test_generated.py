"""Effects hidden by independent code: named, or tied with the like; nothing else claimed; the error at the noise."""

import json

import pytest
from click.testing import CliRunner

from hysteresis_bench.commands.diagnose import diagnose as command
from hysteresis_bench.data.data_files import write_csv
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.fit.accuracy import accuracy
from hysteresis_bench.fit.model_file import read_model
from hysteresis_bench.signals import Dataset
from tests.diagnosis.generator import make

pytestmark = pytest.mark.usefixtures("few_laws")

CASES = [
    (1, "bouc-wen", ()),
    (2, "bouc-wen", ()),
    pytest.param(3, "bouc-wen", ("saturation",), marks=pytest.mark.long),
    (4, "bouc-wen", ("temperature-sensitivity",)),
    (5, "bouc-wen", ("backlash",)),
    (6, "bouc-wen", ("creep",)),
    pytest.param(7, "bouc-wen", ("asymmetry", "input-lag"), marks=pytest.mark.long),
    pytest.param(8, "bouc-wen", ("drift", "periodic-disturbance"), marks=pytest.mark.long),
    (9, "jiles-atherton", ()),
    (10, "jiles-atherton", ("fatigue",)),
    pytest.param(11, "free-energy", ("output-lag",), marks=pytest.mark.long),
]


@pytest.mark.parametrize(("seed", "model", "hidden"), CASES)
def test_what_is_hidden_is_named(seed, model, hidden):
    case = make(seed, model, hidden)
    found = diagnose(case.dataset, Question(model, options=DiagnosisOptions(jobs=1)))
    alike = {effect: {effect, *(one.rival for one in found.ties if one.effect == effect)} for effect in found.effects}
    missed = [effect for effect in hidden if not any(effect in names for names in alike.values())]
    extra = [effect for effect, names in alike.items() if not names & set(hidden)]
    assert (missed, extra) == ([], [])
    assert found.verdict == ("effect-found" if hidden else "no-effect-needed")
    unseen = accuracy(found.after.problem.system, case.unseen, found.after.values).rmse
    assert unseen < 1.15 * case.noise
    if hidden:
        assert found.before.held_out.rmse > 1.5 * found.after.held_out.rmse
    else:
        assert found.after is found.before


def test_the_command_writes_what_predict_reads(tmp_path):
    case = make(12, "bouc-wen", ("drift",))
    files = []
    for record in case.dataset.records[:3]:
        files.append(tmp_path / f"{record.name}.csv")
        write_csv(files[-1], Dataset((record,)))
    out = tmp_path / "out"
    names = [str(file) for file in files]
    ran = CliRunner().invoke(command, [*names, "--model", "bouc-wen", "--out", str(out), "--jobs", "1"])
    assert ran.exit_code == 0, ran.output
    assert "drift" in ran.output
    told = json.loads((out / "diagnosis.json").read_text())
    assert told["schema"] == 1
    assert told["effects"] == ["drift"]
    assert told["split"]["held_out"] == ["fit-3"]
    row = next(row for row in told["candidates"] if row["effect"] == "drift")
    assert row["adopted"]
    assert row["p_value"] < 1e-4
    fitted = read_model(out / "model.json")
    assert fitted.parameters["drift.rate"].value == pytest.approx(row["parameters"]["rate"], rel=0.05)
    predicted = fitted.predict(Dataset(case.unseen)).records[0]
    error = predicted.output - case.unseen[0].output
    assert (error @ error / error.size) ** 0.5 < 1.15 * case.noise
