"""Plugins that break one promise each are found out, and told in a sentence that says what is wrong."""

import os
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner
from numba.core.event import trigger_event

from hysteresis_bench import registry
from hysteresis_bench.cli import main
from hysteresis_bench.testing.check import BROKEN, CONTRACTS, KEPT, Question, answer, check
from hysteresis_bench.testing.contract import promises
from hysteresis_bench.testing.contracts.limit import Overrun, within
from tests.conftest import forget_plugins

FOLDER = str(Path(__file__).parents[1] / "broken_plugins")

TOLD = {
    "optimizers": {
        "goes-on": "catches BudgetSpent and goes on",
        "outside": "proposes a point outside the unit box",
        "unseeded": "the same seed gives another search",
        "global": "changes numpy's global random numbers",
        "reseeds": "changes Python's global random numbers",
        "overwrites": "writes into the first points",
        "buys": "has no setter",
        "remembers": "a second use answers otherwise",
        "silences": "changes numpy's handling of floating-point errors",
        "threads": "changes the number of threads",
        "prints": "prints 'generation 1",
        "mutable": "a @dataclass without frozen=True",
        "swallows": "swallows the exception that a model raises",
        "exits": "SystemExit: 0",
        "undecorated": "is no @dataclass(frozen=True)",
        "demands": "the setting particles has no default",
    },
    "models": {
        "not-finite": "it answers nan at sample 0 for a = 9",
        "corner": "at a corner of the box of the data it answers nan",
        "overwrites": "writes into what it was given",
        "turned": "answers the shape (7, 241); (samples, swarm) is (241, 7)",
        "single": "answers float32; float64 is asked",
        "coupled": "gets another answer than alone",
        "remembers": "a second use answers otherwise",
        "unmeant": "a has no meaning",
        "odd-unit": "may name {input}, {output} and {time} only",
        "no-room": "whose input never moves: a: low and high are both 0",
        "not-linear": "is not affine in a",
        "parameterless": "Parameterless lacks parameters",
    },
    "effects": {
        "not-neutral": "at its null it changes bits",
        "no-null": "no parameter has a null",
        "other-unit": "data in other units give the box",
        "sampled": "four times as many samples of the same line change its answer",
        "jumps": "a jump",
        "overwrites": "writes into what it was given",
        "hides-nothing": "changes the output by 0",
        "mistaken": 'no effect "asymmetri"',
        "nowhere": 'no acts "outside"',
    },
    "rigs": {
        "unitless": "output has no unit",
        "unseeded": "gives other data with the same generator",
        "backwards": "times must be finite and strictly increase",
        "anything": "measures an experiment that it does not declare",
        "promises": "NotImplementedError: not yet",
        "no-experiments": "lacks experiments",
    },
}


@pytest.fixture(scope="module", autouse=True)
def _installed():
    """The distribution is there for this module alone."""
    sys.path.append(FOLDER)
    before = os.environ.get("PYTHONPATH")
    os.environ["PYTHONPATH"] = FOLDER if before is None else f"{before}{os.pathsep}{FOLDER}"
    forget_plugins()
    yield
    sys.path.remove(FOLDER)
    os.environ.pop("PYTHONPATH") if before is None else os.environ.update(PYTHONPATH=before)
    forget_plugins()


def reasons(kind: str, name: str) -> list[str]:
    """Why promises are broken, all of them tried in this process."""
    fault = registry.load(kind, name).fault
    verdicts = [] if fault else [answer(Question(kind, name, method, 60.0)) for method in promises(CONTRACTS[kind])]
    return [fault] * bool(fault) + [verdict.reason for verdict in verdicts if verdict.status == BROKEN]


@pytest.mark.parametrize(("kind", "name"), [(kind, name) for kind, told in TOLD.items() for name in told])
def test_what_is_broken_is_told(kind, name):
    told = reasons(kind, f"broken-{name}")
    assert any(TOLD[kind][name] in reason for reason in told), told


def test_each_is_tried():
    for kind, told in TOLD.items():
        broken = {name.removeprefix("broken-") for name in registry.names(kind) if name.startswith("broken-")}
        assert broken - {"hangs", "hangs-deep"} == set(told)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("broken-hangs", "stopped after 2 s, compilation not counted; what had not been tried"),
        ("broken-hangs-deep", "stopped, as it hangs in compiled code; what had not been tried"),
    ],
)
def test_what_hangs_is_told_and_ends_the_questions(name, told):
    begun = time.monotonic()
    *kept, last = check("optimizers", name, timeout=2.0)
    assert time.monotonic() - begun < 120.0
    assert [verdict.status for verdict in kept] == [KEPT]
    assert last.promise == promises(CONTRACTS["optimizers"])["test_its_settings_stay"]
    assert last.reason.startswith(told)


def test_compilation_does_not_count():
    with within(0.3), trigger_event("numba:compile"), trigger_event("numba:compile"):
        time.sleep(0.6)
    with pytest.raises(Overrun), within(0.1):
        time.sleep(20.0)


def test_the_command_tells_all_in_order_and_its_exit_code_says_so():
    good = CliRunner().invoke(main, ["check-plugin", "random-search"])
    assert good.exit_code == 0, good.output
    assert "Every promise is kept." in good.output
    assert "times the median of the" in good.output
    bad = CliRunner().invoke(main, ["check-plugin", "broken-exits", "--kind", "optimizer"])
    assert bad.exit_code == 1
    assert "optimizer broken-exits of hysteresis-broken-plugins 0.2" in bad.output
    assert "promises are broken" in bad.output
    unloadable = CliRunner().invoke(main, ["check-plugin", "broken-parameterless"])
    assert unloadable.exit_code == 1
    assert "lacks parameters" in unloadable.output
    assert CliRunner().invoke(main, ["check-plugin", "random-serch"]).exit_code == 2


def test_a_fault_is_listed_with_the_distribution_that_it_is_of():
    told = " ".join(CliRunner().invoke(main, ["list", "models"], env={"COLUMNS": "200"}).output.split())
    assert "broken: Parameterless lacks parameters hysteresis-broken-plugins 0.2" in told
    assert "broken: Parameterless lacks parameters" in CliRunner().invoke(main, ["list", "broken-parameterless"]).output


def test_one_plugin_is_told_with_parameters_settings_and_source():
    told = CliRunner().invoke(main, ["list", "bouc-wen"], env={"COLUMNS": "200"}).output
    for words in ("model bouc-wen of hysteresis-bench", "smoothness of the loop", "output/input", "0 to 5", "1.0"):
        assert words in told
    assert "models/bouc_wen.py" in told
    assert "offered by bouc-wen" in CliRunner().invoke(main, ["list", "eddy-current"]).output
    assert "pwm-60s" in CliRunner().invoke(main, ["list", "sma"]).output
