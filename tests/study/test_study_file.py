"""Study files: every fault at once, each with its place and the nearest known name."""

import pytest

from hysteresis_bench.errors import UserError
from hysteresis_bench.study.problems import closing_dataset
from hysteresis_bench.study.strict import duration
from hysteresis_bench.study.study_file import read_study

GOOD = """
title = "t"
seed = 1
[[problem]]
name = "p"
model = "polynomial"
data = ["a.csv"]
[[optimizer]]
plugin = "pso"
"""


def read(folder, text):
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    return read_study(path)[0]


def told(folder, text):
    with pytest.raises(UserError) as error:
        read(folder, text)
    return error.value.faults


def test_a_good_file_and_its_defaults(tmp_path):
    study = read(tmp_path, GOOD)
    assert (study.trials, study.budget, study.timeout, study.reference) == (3, 15050, 600.0, "pso")
    assert study.labels == ["pso"]


def test_the_box_follows_the_data_where_there_are_data_files_as_in_a_fit(tmp_path):
    on_rig = 'rig = "sma"\nfitted = ["pwm-60s"]'
    assert read(tmp_path, GOOD).problem[0].box == "data"
    assert read(tmp_path, GOOD.replace('data = ["a.csv"]', on_rig)).problem[0].box == "model"
    assert read(tmp_path, GOOD.replace("data =", 'box = "model"\ndata =')).problem[0].box == "model"


@pytest.mark.parametrize(("text", "seconds"), [("10 min", 600), ("90 s", 90), ("1.5h", 5400), (12, 12)])
def test_times(text, seconds):
    assert duration(text) == seconds


def test_all_faults_of_a_bad_file_at_once(tmp_path):
    text = """
title = "t"
sed = 1
timeout = "soon"
[[problem]]
name = "p"
model = "polynomal"
data = ["a.csv"]
[[problem]]
name = "q"
model = "polynomial"
rig = "smaa"
data = ["a.csv"]
bounds = { a = [2.0, 1.5], z = [0, 1] }
loss = "rsme"
[[optimizer]]
plugin = "psoo"
[[optimizer]]
plugin = "pso"
settings = { particels = 10 }
"""
    faults = " ".join(told(tmp_path, text))
    for part in (
        'no key "sed"',
        'Did you mean "seed"',
        "seed: field required",
        "'soon'",
        'no model "polynomal"',
        'Did you mean "polynomial"',
        "[[problem]] 2: name either a rig",
        'no rig "smaa"',
        "a: low 2.0 is above high 1.5",
        'no parameter "z"',
        'no loss "rsme"',
        '[[optimizer]] 1: no optimizer "psoo"',
        '[[optimizer]] 2: pso has no setting "particels"',
        'Did you mean "particles"',
    ):
        assert part.lower() in faults.lower(), part


@pytest.mark.parametrize(
    ("change", "part"),
    [
        (("[[optimizer]]", '[[optimizer]]\nplugin = "pso"\n[[optimizer]]'), 'two [[optimizer]] are both called "pso"'),
        (('plugin = "pso"', 'plugin = "pso"\nsettings = { particles = "many" }'), "particles = 'many'"),
        (('plugin = "pso"', 'plugin = "pso"\nsettings = 3'), "[[optimizer]] 1 settings: input should be a table"),
        (('data = ["a.csv"]', 'data = ["a.csv"]\nbounds = 3'), "[[problem]] 1 bounds: input should be a table"),
        (
            ('data = ["a.csv"]', 'data = ["a.csv"]\neffects = "bias"'),
            "1 effects: input should be a valid list",
        ),
        (('plugin = "pso"', 'plugin = "faulty-missing"'), "is broken"),
        (('plugin = "pso"', 'plugin = "faulty-abstract"'), "Abstract lacks search"),
        (('plugin = "pso"', 'plugin = "faulty-alien"'), "does not keep the contract Optimizer"),
        (('data = ["a.csv"]', 'data = ["a.csv"]\neffects = ["bais"]'), 'Did you mean "bias"'),
        (("seed = 1", "seed = 1\ntrials = 0"), "trials"),
        (('data = ["a.csv"]', 'rig = "sma"\nfitted = ["pwm-60"]'), 'Did you mean "pwm-60s"'),
        (("seed = 1", "seed = = 1"), "not valid TOML"),
    ],
)
def test_single_faults(tmp_path, change, part):
    assert part in " ".join(told(tmp_path, GOOD.replace(*change)))


CLOSING = """
title = "t"
seed = 1
[[problem]]
name = "p"
model = "jiles-atherton"
rig = "sma"
fitted = ["pwm-60s"]
[[optimizer]]
plugin = "pso"
[closing]
model = "jiles-atherton"
fitted = ["pwm-60s"]
held_out = ["pwm-50s"]
"""


def test_a_closing_takes_the_rig_of_its_problem_and_makes_no_other_study(tmp_path):
    study = read(tmp_path, CLOSING)
    assert study.closing.fitted == ["pwm-60s"]
    assert closing_dataset(study, tmp_path).held_out[0].name == "pwm-50s"
    assert read(tmp_path, CLOSING[: CLOSING.index("[closing]")]).identity() == study.identity()


def test_all_faults_of_a_closing_at_once(tmp_path):
    text = (
        CLOSING[: CLOSING.index("[closing]")]
        + """
[closing]
model = "jiles-athertn"
after = "q"
fited = ["pwm-60s"]
held_out = ["pwm-50", "slow", "slow"]
effects = ["input-lga"]
says = 3
"""
    )
    faults = " ".join(told(tmp_path, text.replace('after = "q"', "")))
    for part in (
        '[closing]: no key "fited". Known:',
        'Did you mean "fitted"',
        "[closing] fitted: field required",
        "[closing] says: input should be text, in quotes",
        '[closing]: no model "jiles-athertn"',
        'no effect "input-lga"',
        'held_out: rig sma has no experiment "pwm-50". Known:',
        '[closing]: "slow" is named twice',
    ):
        assert part in faults, part
    assert '[closing]: after: no problem "q". Known: p.' in " ".join(told(tmp_path, text))


@pytest.mark.parametrize(
    ("change", "part"),
    [
        (('held_out = ["pwm-50s"]', "held_out = []"), "[closing] held_out: list should have at least 1 item"),
        (('held_out = ["pwm-50s"]', 'held_out = "pwm-50s"'), "[closing] held_out: input should be a valid list"),
        (('held_out = ["pwm-50s"]', 'held_out = ["pwm-60s"]'), "what is held out must not be fitted"),
        (('rig = "sma"', 'rig = "smaa"'), 'no rig "smaa"'),
        (("[closing]\n", "[closing]\nsettings = { clampd = true }\n"), "[closing]: jiles-atherton has no setting"),
    ],
)
def test_single_faults_of_a_closing(tmp_path, change, part):
    faults = told(tmp_path, CLOSING.replace(*change))
    assert part in " ".join(faults)
    assert len(faults) == len(set(faults))


def test_a_closing_that_is_no_table(tmp_path):
    text = CLOSING[: CLOSING.index("[closing]")].replace("seed = 1", 'seed = 1\nclosing = "yes"')
    assert any(fault.startswith("closing: ") for fault in told(tmp_path, text))
