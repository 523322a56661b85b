"""What breaks its contract is caught with a sentence: models, effects, names, fitted models."""

import json
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench import predict, registry
from hysteresis_bench.cli import main
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Effect, Model
from hysteresis_bench.data.data_files import write_csv
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.checks.behaviour import broken_promises
from hysteresis_bench.fit.fitting import fit_records
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.fit.model_file import write_model
from hysteresis_bench.fit.objective import Problem
from hysteresis_bench.parameters import Parameter, Space
from hysteresis_bench.signals import Dataset
from hysteresis_bench.study.execution.trial import Ticket, run_trial
from hysteresis_bench.study.problems import Built
from hysteresis_bench.study.study_file import check_study
from tests.conftest import forget_plugins, record

SECOND = str(Path(__file__).parents[1] / "second_distribution")


@dataclass(frozen=True)
class Mute(Model):
    """Answers NaN, whatever it is asked."""

    parameters = (Parameter("a", 0.0, 1.0),)

    def simulate(self, signal, p):
        return np.full((signal.input.shape[0], p.a.size), np.nan)


class Scribbler(Mute):
    """Writes into the input."""

    def simulate(self, signal, p):
        signal.input[0] = 0.0
        return signal.input * p.a


class Editor(Mute):
    """Writes into its parameters."""

    def simulate(self, signal, p):
        p.a[:] = 0.5
        return signal.input * p.a


class Narrow(Mute):
    """Answers for one particle, however many there are."""

    def simulate(self, signal, p):
        return signal.input * p.a[:1]


class Gain(Mute):
    """y = a u."""

    def simulate(self, signal, p):
        return signal.input * p.a


@dataclass(frozen=True)
class Shift(Effect):
    """Adds a little more than it says."""

    acts = "output"
    family = "curve of the output"
    parameters = (Parameter("by", -1.0, 1.0, null=0.0),)
    extra: float = 0.25

    def apply(self, inner, signal, p):
        return inner(signal) + p.by + self.extra


@pytest.mark.parametrize(
    ("model", "told"),
    [
        (Mute, "Mute answers no finite number at any of 3 points of its box"),
        (Scribbler, "Scribbler ends with ValueError: assignment destination is read-only"),
        (Editor, "Editor writes into the parameters that it is given"),
        (Narrow, r"Narrow must answer an array \(samples, swarm\) = \(40, 3\), not \(40, 1\)"),
    ],
)
def test_a_model_that_breaks_its_contract(model, told):
    with pytest.raises(AssertionError, match=told):
        assert not broken_promises(System(model()), [record()])


def test_an_effect_that_changes_something_at_its_null_value():
    (told,) = broken_promises(System(Gain(), (("shift", Shift()),)), [record()])
    assert told.startswith("effect shift changes the output by up to 0.25 at its null value (shift.by = 0)")
    assert not broken_promises(System(Gain(), (("shift", Shift(extra=0.0)),)), [record()])
    fixed = System(Gain(), (("shift", Shift()),), {"shift.by": 0.5})
    assert broken_promises(fixed, [record()]) == [told]


def test_a_trial_whose_best_loss_is_the_ceiling_has_failed():
    system = System(Mute())
    problem = Problem(system, (record(),), Space(system.parameters), LOSSES["rmse"])
    study = check_study(
        {
            "title": "t",
            "seed": 1,
            "problem": [{"name": "p", "model": "polynomial", "data": ["x.csv"]}],
            "optimizer": [{"plugin": "pso"}],
        },
        "t",
    )
    ticket = Ticket(study.model_dump_json(), ".", "p", "pso", 0)
    ended = run_trial(ticket, Built(problem, Dataset((record(),))), registry.build("optimizers", "pso"), 60)
    assert (ended.status, ended.fitness, ended.trace) == ("no-finite-loss", None, None)
    assert ended.reason == "none of 60 simulations was finite"


@pytest.fixture(scope="module")
def fitted():
    return fit_records(Dataset((record(),)), "polynomial").model


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 1e308])
def test_a_fitted_model_with_a_wild_number_predicts_nothing(fitted, value, tmp_path):
    path, data = tmp_path / "model.json", tmp_path / "data.csv"
    write_model(path, fitted)
    write_csv(data, Dataset((record(),)))
    content = json.loads(path.read_text())
    content["parameters"]["a"]["value"] = value
    path.write_text(json.dumps(content))
    with pytest.raises(UserError, match=r"must be finite|too large to work with"):
        predict(path, data)


def test_a_prediction_that_is_not_finite_is_none(fitted):
    huge = replace(fitted, parameters={name: replace(one, value=1e99) for name, one in fitted.parameters.items()})
    with pytest.raises(UserError, match="not finite"), np.errstate(over="ignore"):
        huge.predict(Dataset((replace(record(), input=np.full(40, 1e80)),)))


@pytest.fixture
def _second():
    sys.path.append(SECOND)
    forget_plugins()
    yield
    sys.path.remove(SECOND)
    forget_plugins()


@pytest.mark.usefixtures("_second")
def test_two_plugins_of_one_name_are_a_fault_that_names_both():
    both = "registered by hysteresis-bench 0.1.0 and by second-distribution 1.2; uninstall all but one of them"
    assert registry.load("optimizers", "pso").fault == both
    assert registry.faults("optimizers", "pso", {}) == [f'optimizer "pso" is broken: {both}']
    listed = [one for one in registry.registered("optimizers") if one.name == "pso"]
    assert [one.distribution for one in listed] == ["hysteresis-bench", "second-distribution"]
    told = CliRunner().invoke(main, ["list", "optimizers"], env={"COLUMNS": "300"}).output
    assert told.count(both) == 2
    assert not registry.load("optimizers", "leaves").shipped


def test_a_plugin_that_exits_when_it_is_imported_is_broken():
    code = "from hysteresis_bench import registry as r; print(r.load('optimizers', 'leaves').fault)"
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.append({SECOND!r}); {code}", "exit"],
        capture_output=True,
        text=True,
    )
    assert done.stdout.strip() == "SystemExit: 0"
