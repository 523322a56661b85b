"""What is said of zeros that every record has for itself."""

from types import SimpleNamespace

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.diagnosis.findings.stages import own_zeros
from hysteresis_bench.signals import Record

TIME = np.linspace(0.0, 2.0, 400)
U = 3.0 * np.sin(2 * np.pi * TIME)


def staged(*effects):
    """A stage with a Bouc-Wen law that the records follow but for their zeros."""
    model = registry.build("models", "bouc-wen")
    system = System(model, registry.build_effects(model, effects))
    values = np.array([model.example.parameters[p.name] for p in model.parameters])
    y = System(model).simulate(Record(TIME, U, None).signal, values[:, None])[:, 0]
    zeros = {"dec": -4.2, "grw": 3.1, "ms": 1.7}
    records = [Record(TIME, U, y + zero, name) for name, zero in zeros.items()]
    return SimpleNamespace(names=effects, problem=SimpleNamespace(system=system), values=values), records


def test_zeros_of_records_are_told_with_the_one_that_is_predicted():
    stage, records = staged("record-offset")
    assert own_zeros(stage, records, True, " nm") == (
        "Every record has a zero of its own, from -4.2 nm (dec) to 3.1 nm (grw): errors are told beside it, also of "
        "what was held out. Of a new record nobody knows it; `predict` takes the middle one, 1.7 nm."
    )
    assert "held out" not in own_zeros(stage, records, False, "")


def test_one_record_or_one_zero_for_all_is_not_told():
    stage, records = staged("record-offset")
    assert own_zeros(stage, records[:1], True, "") == ""
    assert own_zeros(staged()[0], records, True, "") == ""
