"""A plugin whose module is gone, as after an update by half, stops nobody who asks about another one."""

import numpy as np
import pytest

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.laws.surroundings import curves, drifts
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.diagnosis_study.hidden_effects import can_be_hidden, can_make_data
from hysteresis_bench.signals import Dataset, Record
from tests.conftest import forget_plugins, record

POINTS = "".join(f"[hysteresis_bench.{kind}]\ngone-away = gone_away:Gone\n" for kind in ("models", "effects"))


@pytest.fixture(autouse=True)
def _gone(tmp_path, monkeypatch):
    home = tmp_path / "gone_away-0.1.dist-info"
    home.mkdir()
    (home / "METADATA").write_text("Metadata-Version: 2.1\nName: gone-away\nVersion: 0.1\n", encoding="utf-8")
    (home / "entry_points.txt").write_text(POINTS, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    forget_plugins()
    yield
    monkeypatch.undo()
    forget_plugins()


def test_it_is_known_and_not_usable():
    for kind in ("models", "effects"):
        assert "gone-away" in registry.names(kind)
        assert {*registry.names(kind)} - {*registry.usable(kind)} == {"gone-away"}
    assert "gone-away" not in can_make_data()
    model = registry.build("models", "bouc-wen")
    assert "gone-away" not in can_be_hidden(model)
    stack = Stack(model, (record(), record()))
    assert "gone-away" not in {*drifts(stack), *curves(stack), *stack.candidates()[0]}
    assert stack.candidates()[1]["gone-away"].startswith("broken: ")


def test_a_diagnosis_around_another_model_ends():
    """Far from the noise, where other laws are asked."""
    rng, time = np.random.default_rng(1), np.linspace(0.0, 4.0, 400)
    records = []
    for name, frequency in (("slow", 0.5), ("fast", 1.5)):
        drive = np.sin(2 * np.pi * frequency * time)
        output = np.cumsum(np.gradient(drive) * (1.0 + (np.gradient(drive) > 0) * drive)) + drive**3
        records.append(Record(time, drive, output + 0.001 * rng.standard_normal(400), name=name))
    found = diagnose(Dataset(tuple(records)), Question("bouc-wen", among=("bias",), options=DiagnosisOptions(jobs=1)))
    assert found.model_name == "bouc-wen"
