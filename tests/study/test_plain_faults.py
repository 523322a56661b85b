"""Faults of a study file in its own words: brackets, ranges, types, the reference, what is fixed."""

import pytest

from hysteresis_bench.study.problems import boxed, build_system
from tests.study.test_study_file import GOOD, read, told

BOUC_WEN = GOOD.replace("polynomial", "bouc-wen")


def with_line(line):
    """The good study, with a line in its problem."""
    return BOUC_WEN.replace("data =", f"{line}\ndata =")


def test_a_reference_that_is_no_optimizer_of_the_study(tmp_path):
    sentence = 'reference: no optimizer "psso" in this study. Known: pso. Did you mean "pso"?'
    assert told(tmp_path, f'reference = "psso"\n{BOUC_WEN}') == [sentence]
    assert read(tmp_path, BOUC_WEN.replace('"pso"', '"random-search"')).reference == "pso"  # nobody named it


def test_the_wrong_brackets(tmp_path):
    assert told(tmp_path, BOUC_WEN.replace("[[problem]]", "[problem]")) == [
        "[problem] should be [[problem]], in two brackets: there may be several."
    ]
    assert told(tmp_path, f"{BOUC_WEN}[[closing]]\n") == [
        "[[closing]] should be [closing], in one bracket: there is one."
    ]


@pytest.mark.parametrize("bounds", ["1", "[1]", "[1, 2, 3]", "[true, 2]", '["1", 2]', '"12"'])
def test_bounds_are_two_numbers(tmp_path, bounds):
    faults = told(tmp_path, with_line(f"bounds = {{ alpha = {bounds} }}"))
    assert faults == ["[[problem]] 1 bounds alpha: should be two numbers, lower and upper, such as [0, 1]."]


def test_bounds_that_reach_down_to_0_are_linear_as_in_a_fit_but_no_logarithm(tmp_path):
    down_to_0 = GOOD.replace("data =", "bounds = { b = [0, 5] }\ndata =")
    spec = read(tmp_path, down_to_0).problem[0]
    parameters, faults = boxed(build_system("polynomial").parameters, spec)
    assert not faults
    assert (parameters[1].lower, parameters[1].scaling) == (0.0, "linear")
    (fault,) = told(tmp_path, down_to_0.replace("data =", 'scaling = "log"\ndata ='))
    assert "b: log scaling needs a low bound above 0" in fault


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ('settle = "yes"', "settle: input should be true or false."),
        ("settle = 1", "settle: input should be true or false."),
        ('instances = "3"', "instances: input should be a whole number."),
        ("most_trials = true", "most_trials: input should be a whole number."),
        ("loss = 3", "loss: input should be text, in quotes."),
        ("layout = 3", "layout: input should be a table."),
        ('fixed = { alpha = "1" }', "fixed alpha: input should be a number."),
    ],
)
def test_values_of_another_type(tmp_path, line, sentence):
    assert told(tmp_path, with_line(line)) == [f"[[problem]] 1 {sentence}"]


def test_what_is_fixed_is_told_all_at_once(tmp_path):
    line = 'effects = ["creep"]\nfixed = { alpha = nan, foo = 1, "creep.foo" = 1, "creep.time_constant" = inf }'
    unknown, of_effect, alpha, creep = told(tmp_path, with_line(line))
    assert 'fixed: bouc-wen with creep has no parameter "foo". Known: alpha,' in unknown
    assert 'has no parameter "creep.foo". Known: alpha,' in of_effect
    assert (alpha[15:], creep[15:]) == (
        "fixed alpha = nan must be finite.",
        "fixed creep.time_constant = inf must be finite.",
    )


def test_a_stage_without_a_model(tmp_path):
    stage = '[[stage]]\nname = "s"\nafter = "p"\nfit = ["b", "c_over_m", "k_over_m"]\nfitted = ["x"]\n'
    assert told(tmp_path, BOUC_WEN + stage) == ["[[stage]] 1 model: field required."]
    assert told(tmp_path, f'{BOUC_WEN}[[stage]]\nname = "s"\nmodel = "hammerstein"\nfit = "b"\nfitted = ["x"]\n') == [
        "[[stage]] 1 after: field required.",
        "[[stage]] 1 fit: input should be a list.",
    ]
