"""Whatever stands in a study file, it is a study or gets sentences: never a traceback."""

import copy
import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hysteresis_bench.errors import UserError
from hysteresis_bench.study.study_file import check_study

STUDIES = Path(__file__).parents[2] / "studies"
RAW = {name: tomllib.loads((STUDIES / f"{name}.toml").read_text(encoding="utf-8")) for name in ("sma", "pea")}
ODD = [1, -1, 0.5, True, "x", "", [], {}, [1], ["a"], [["a"]], [[]], [{}], {"a": 1}, {"a": []}, {"a": [1]},
       {"a": [2, 1]}, {"a": [1, 2, 3]}, {"a": {}}, float("nan"), float("inf"), "a\x00b", "\x1b[31m", 10**400,
       "é" * 900]  # fmt: skip
PROBLEM = ("held_out", "loss", "profile", "bounds", "settings", "fitted", "optimizers", "effects", "fixed", "data",
           "rig", "rig_settings", "scaling", "skip", "settle", "box", "model", "name")  # fmt: skip
PLACES = [
    *(("problem", 0, key) for key in PROBLEM),
    *(("optimizer", 0, key) for key in ("settings", "label", "budget", "plugin")),
    *((key,) for key in ("notes", "published", "timeout", "seed", "trials", "budget", "reference", "stage", "closing")),
    *(("closing", key) for key in ("fitted", "held_out", "effects", "model", "settings", "after")),
    *(("stage", 0, key) for key in ("optimizers", "fit", "check", "control", "beside", "after", "model")),
    ("problem", 0, "bounds", "alpha"),
    ("problem",),
    ("optimizer", 1),
]


def with_value(name, place, value):
    """The study with one value in it replaced, or None where it has no such place."""
    raw = copy.deepcopy(RAW[name])
    inner = raw
    for part in place[:-1]:
        if isinstance(part, str) and part not in inner:
            return None
        inner = inner[part]
    inner[place[-1]] = value
    return raw


@settings(max_examples=120, deadline=None, derandomize=True)
@given(st.sampled_from(sorted(RAW)), st.sampled_from(PLACES), st.sampled_from(ODD))
def test_one_odd_value_is_a_study_or_a_sentence(name, place, value):
    raw = with_value(name, place, value)
    if raw is None:
        return
    faults: list[str] = []
    try:
        check_study(raw, "a.toml")
    except UserError as error:
        faults = error.faults
    assert all(fault.isprintable() and len(fault) < 1100 for fault in faults)


def test_a_name_of_any_length_leaves_room_for_the_known_ones():
    raw = with_value("pea", ("problem", 0, "loss"), "é" * 100_000)
    with pytest.raises(UserError) as raised:
        check_study(raw, "a.toml")
    (fault,) = raised.value.faults
    assert len(fault) < 300
    assert "Known: relative-rms-per-root-sample, rmse" in fault


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        (("problem", 0, "held_out"), 1, "held_out"),
        (("problem", 0, "loss"), [[]], "loss"),
        (("problem", 0, "profile"), [0], "profile"),
        (("problem", 0, "profile"), [{"a": {}}, ""], "profile"),
        (("problem", 0, "bounds"), "x", "bounds"),
        (("optimizer", 0, "settings"), -1, "settings"),
        (("problem", 0, "fitted"), ["pwm-60s", "pwm-60s"], '"pwm-60s" is named twice'),
        (("problem", 0, "optimizers"), ["pso", "pso"], '"pso" is named twice'),
        (("optimizer", 0, "label"), "a\tb", "cannot be printed"),
        (("published",), "../elsewhere.toml", "lies outside"),
        (("timeout",), 10**400, "is not a time"),
        (("optimizer", 0, "settings"), {"particles": 10**400}, "must be of type int"),
    ],
)
def test_the_sentence_names_the_place(place, value, words):
    with pytest.raises(UserError, match=words) as told:
        check_study(with_value("sma", place, value), "a.toml")
    assert "fault" not in str(told.value) or len(told.value.faults) > 1
    assert len(told.value.faults) <= 3
