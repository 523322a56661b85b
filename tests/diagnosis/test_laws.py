"""Laws beside each other: the true one is found, a memoryless device is told, what is held out chooses nothing."""

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench import compare, diagnose, fit, registry
from hysteresis_bench.cli import main
from hysteresis_bench.compose import System
from hysteresis_bench.data.data_files import write_csv
from hysteresis_bench.diagnosis.hypotheses.systems import Stack
from hysteresis_bench.diagnosis.laws.baseline import baseline_errors, polynomial
from hysteresis_bench.diagnosis.laws.comparison import BASELINE, OPEN
from hysteresis_bench.diagnosis.laws.comparison import compare as ranked
from hysteresis_bench.diagnosis.laws.passing import Passing
from hysteresis_bench.diagnosis.laws.surroundings import changes, curves, drifts, linear_dynamics
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.settling import CLOSED, passed
from hysteresis_bench.fit.unseen.whole import left_out
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 2.0, 900)
ONE = DiagnosisOptions(jobs=1)
QUICK = ("bouc-wen", "jiles-atherton", "prandtl-ishlinskii", "dahl")


def drive(amplitude: float, frequency: float) -> np.ndarray:
    return amplitude * (np.sin(2 * np.pi * frequency * TIME) + 0.4 * np.sin(5.3 * np.pi * frequency * TIME))


def records(response, noise: float = 0.01) -> tuple[Record, ...]:
    """Three excitations; response(u) -> output."""
    rng, made = np.random.default_rng(3), []
    for number, (amplitude, frequency) in enumerate(((1.0, 1.5), (2.0, 1.0), (1.5, 2.5))):
        u = drive(amplitude, frequency)
        y = response(u)
        made.append(Record(TIME, u, y + noise * np.std(y) * rng.standard_normal(y.size), name=f"run {number}"))
    return tuple(made)


def of(name: str, **values: float):
    system = System(registry.build("models", name))

    def response(u: np.ndarray) -> np.ndarray:
        p = np.array([[values[q.name]] for q in system.parameters])
        return system.simulate(Record(TIME, u, None).signal, p)[:, 0]

    return response


BOUC_WEN = of("bouc-wen", alpha=0.5, beta=1.2, gamma=0.2, d=1.5)


def test_the_true_law_is_found_and_reaches_the_noise():
    found = compare(Dataset(records(BOUC_WEN)), QUICK, options=ONE)
    assert found.chosen == "bouc-wen"
    best = found.table.iloc[0]
    assert best["law"] == "bouc-wen"
    assert best["unseen"] < 1.15 * found.floor
    assert found.table.set_index("law").loc[BASELINE, "unseen"] > 10.0 * best["unseen"]


def test_without_memory_no_law_beats_the_polynomial():
    found = compare(Dataset(records(lambda u: 1.0 + u + 0.2 * u**3)), ("dahl", "jiles-atherton"), options=ONE)
    assert found.chosen == ""
    assert "without memory" in found.words


def test_what_is_held_out_chooses_nothing():
    three = records(BOUC_WEN)
    without_memory = polynomial(three[:2]).errors(three[2])
    strange = replace(three[2], output=three[2].measured - without_memory)
    one, other = (
        compare(Dataset((*three[:2], last), (last.name,)), QUICK, options=ONE) for last in (three[2], strange)
    )
    columns = ["law", "parameters", "fitted", "unseen"]
    assert one.chosen == other.chosen
    assert one.table[columns].equals(other.table[columns])
    assert not one.table["held_out"].equals(other.table["held_out"])
    assert "worse than the polynomial" in other.words
    assert "worse than the polynomial" not in one.words


def test_the_polynomial_is_least_squares_with_a_constant_a_record():
    u, shifted = drive(1.0, 1.0), drive(2.0, 1.5)
    pair = (Record(TIME, u, 3.0 + 2.0 * u - u**3), Record(TIME, shifted, -5.0 + 2.0 * shifted - shifted**3))
    assert max(np.abs(polynomial(pair).errors(record)).max() for record in pair) < 1e-9
    assert np.abs(baseline_errors(pair, left_out(pair).blocks)).max() < 1e-6


def test_of_a_lone_record_the_simplest_near_law_is_taken_and_it_is_said():
    found = compare(Dataset(records(BOUC_WEN)[:1]), ("bouc-wen", "bouc-wen-generalized"), options=ONE)
    assert found.chosen == "bouc-wen"


def test_a_diagnosis_without_a_model_finds_law_and_effect():
    """The output drifts beside a Bouc-Wen loop."""
    asked = replace(ONE, laws=("bouc-wen", "dahl"))
    found = diagnose(Dataset(records(lambda u: BOUC_WEN(u) + 0.8 * TIME)), options=asked)
    assert (found.model_name, found.effects) == ("bouc-wen", ("drift",))
    assert found.laws is not None
    assert found.unseen < 0.5 * found.laws.table["unseen"].min()
    assert found.unseen < 1.15 * found.floor
    assert found.laws.words in found.warnings[0]


def lagged(u: np.ndarray, constant: float = 0.03) -> np.ndarray:
    """A first-order lag behind the Bouc-Wen loop, exact for an output that is straight between samples."""
    y = BOUC_WEN(u)
    left, z = np.exp(-TIME[1] / constant), np.empty_like(y)
    z[0] = y[0]
    for i, slope in enumerate(np.diff(y) / TIME[1]):
        # z - (y - constant slope) decays
        z[i + 1] = y[i + 1] - constant * slope + left * (z[i] - y[i] + constant * slope)
    return z


@pytest.mark.long
def test_a_lag_makes_no_law_with_dynamics_of_its_own_the_right_one():
    """`hammerstein`, a Bouc-Wen loop before an oscillator, holds a lag in itself, and Bouc-Wen alone does not."""
    data, names = Dataset(records(lagged)), ("hammerstein", "bouc-wen", "dahl")
    assert compare(data, names, options=ONE).chosen == "hammerstein"
    found = diagnose(data, options=replace(ONE, laws=names))
    assert (found.model_name, found.effects) == ("bouc-wen", ("output-lag",))
    assert found.unseen < 1.1 * found.floor


def bent(u: np.ndarray) -> np.ndarray:
    y = BOUC_WEN(u)
    return y + 0.25 * y**2 / np.max(np.abs(y))


def growing(u: np.ndarray) -> np.ndarray:
    return BOUC_WEN(u) * (1.0 + 0.3 * TIME / TIME[-1])


def test_of_a_lone_record_whose_output_turns_late_laws_are_ranked_beside_dynamics():
    """A law with a lag of its own comes first where the others have none."""
    lag = System(
        registry.build("models", "bouc-wen"),
        registry.build_effects(registry.build("models", "bouc-wen"), ("output-lag",)),
    )
    values = {"alpha": 0.5, "beta": 1.2, "gamma": 0.2, "d": 1.5, "output-lag.time_constant": 0.02}
    u = drive(2.0, 1.5) * (1.0 - 0.3 * TIME)
    y = lag.simulate(Record(TIME, u, None).signal, np.array([[values[q.name]] for q in lag.parameters]))[:, 0]
    noisy = y + 0.01 * np.std(y) * np.random.default_rng(4).standard_normal(y.size)
    options = replace(ONE, laws=("bouc-wen", "hammerstein"))
    found = ranked(Dataset((Record(TIME, u, noisy, name="run"),)), Question("", options=options), effects_follow=True)
    assert found.ranked[0] == "bouc-wen"
    assert found.table.set_index("law")["around"].notna()["bouc-wen"]


def test_of_a_lone_record_far_from_the_noise_nothing_around_a_law_counts():
    """What is around a wrong law follows its fault."""
    u = drive(2.0, 1.5) * (1.0 - 0.3 * TIME)
    y = np.cumsum(np.where(np.diff(u, prepend=u[0]) > 0.0, 1.0, 0.3) * np.abs(np.diff(u, prepend=u[0])))
    noisy = y + 0.001 * np.std(y) * np.random.default_rng(4).standard_normal(y.size)
    options = replace(ONE, laws=("bouc-wen", "dahl"))
    found = ranked(Dataset((Record(TIME, u, noisy, name="run"),)), Question("", options=options), effects_follow=True)
    assert found.table["around"].isna().all()


@pytest.mark.parametrize(
    ("response", "richer"), [pytest.param(bent, "preisach", marks=pytest.mark.long), (growing, "prandtl-ishlinskii")]
)
def test_a_law_of_more_parameters_does_not_take_the_place_of_one_with_an_effect(response, richer):
    asked = Question("", options=replace(ONE, laws=("bouc-wen", richer)))
    found = ranked(Dataset(records(response)), asked, effects_follow=True)
    assert found.table.loc[0, "law"] == richer
    assert found.ranked[0] == "bouc-wen"


@pytest.mark.parametrize(("response", "lone"), [(bent, False), (growing, False), (lagged, True)])
def test_what_is_not_asked_for_what_it_predicts_would_not_have_predicted_best(response, lone):
    """Of several effects that one is found which is best by itself."""
    made = records(response)[1:2] if lone else records(response)
    laws = Passing(Dataset(made), settles=False, split=False).begun
    law = laws.law("bouc-wen")

    def asked(stack: Stack) -> list[str]:
        return [*curves(stack), *linear_dynamics(stack)]

    each = asked(laws.fitter("bouc-wen", laws.records).stack)
    alone = [laws.with_any(law, law, lambda _, name=name: [name]) for name in each]
    best = min(alone, key=lambda one: one.rmse)
    found = laws.with_any(law, law, asked)
    assert best.found.names != law.found.names
    assert (found.found.names, found.rmse) == (best.found.names, best.rmse)


def test_what_laws_are_ranked_with_are_effects_that_no_relaxation_makes_up():
    stack = Stack(registry.build("models", "dahl"), records(BOUC_WEN))
    swinging = {"late-input", "resonance", "second-order-lag", "second-order-input-lag", "droop"}
    assert {*curves(stack)} == {
        "damping-curve",
        "input-curve",
        "output-curve",
        "parallel-curve",
        "play-bank",
        *swinging,
    }
    assert {"gain-with-time", "gain-with-path", "disturbance-wave"} <= {*changes(stack)}
    assert not {*changes(stack)} & {*curves(stack), *linear_dynamics(stack)}


def test_laws_are_ranked_with_a_drift_and_linear_dynamics_on_either_side():
    dahl = registry.build("models", "dahl")
    several, one = Stack(dahl, records(BOUC_WEN)), Stack(dahl, (Record(TIME, np.sin(6.0 * TIME), np.sin(6.0 * TIME)),))
    assert (drifts(several), linear_dynamics(several)) == (["record-drift"], ["lags-before", "lags-after"])
    assert linear_dynamics(one) == ["input-lag", "creep", "output-lag", "transport-delay"]  # no curve at one frequency
    untimed = replace(one.records[0], units={"time": "sample"})
    assert linear_dynamics(Stack(dahl, (untimed,))) == []


def test_a_law_is_passed_until_it_closes_the_loop():
    """A creep that is slow beside the faster of two loops."""
    model = registry.build("models", "bouc-wen")
    system = System(model, tuple(registry.build_effects(model, ("creep",))))
    p, turn = np.array([0.3, 0.6, 0.2, 1.0, 0.5, 0.8, 0.0]), np.arange(200) / 200.0
    loops = [Record(turn * period, 4.0 * np.sin(2.0 * np.pi * turn), None, name=f"{period}") for period in (1.0, 0.2)]
    settled = [replace(one, output=system.respond(passed(one, 64), p[:, None])[-200:, 0]) for one in loops]
    passing = Passing(Dataset(tuple(settled)), True, False, ("creep",))
    few, enough = passing.begun.law("bouc-wen"), passing.law("bouc-wen")
    assert few.gap > CLOSED
    assert enough.gap < CLOSED
    assert enough.fitted < 1e-3


def test_faults_are_told_together():
    with pytest.raises(UserError) as told:
        compare(Dataset(records(BOUC_WEN)), ("bouc-when", "dahl", "dahl"), ("dragging",), options=ONE)
    for said in ("bouc-when", "named twice", "dragging"):
        assert said in str(told.value)
    with pytest.raises(UserError, match="name it"):
        diagnose(Dataset(records(BOUC_WEN)), bounds={"alpha": (0.0, 1.0)}, options=ONE)


def test_the_command_writes_table_and_page(tmp_path):
    paths = []
    for record in records(BOUC_WEN):
        paths.append(tmp_path / f"{record.name.replace(' ', '')}.csv")
        write_csv(paths[-1], Dataset((record,)))
    out = tmp_path / "laws"
    said = CliRunner().invoke(
        main,
        [
            "compare",
            *map(str, paths),
            "--models",
            "bouc-wen,dahl",
            "--held-out",
            "run2",
            "--jobs",
            "1",
            "--out",
            str(out),
        ],
    )
    assert said.exit_code == 0, said.output
    assert "bouc-wen predicts best" in " ".join(said.output.split())
    assert (out / "laws.csv").is_file()
    page = (out / "laws.html").read_text()
    assert "bouc-wen follows these data" in page
    assert json.dumps("held out")[1:-1] in page


def test_a_setting_of_the_model_is_taken_from_the_command_line(tmp_path):
    path = tmp_path / "run.csv"
    write_csv(path, Dataset(records(BOUC_WEN)[:1]))
    asked = ["fit", str(path), "--model", "prandtl-ishlinskii", "--out", str(tmp_path / "fit")]
    said = CliRunner().invoke(main, [*asked, "--set", "plays=3"])
    assert said.exit_code == 0, said.output
    assert json.loads((tmp_path / "fit" / "model.json").read_text())["settings"] == {"plays": 3}
    said = CliRunner().invoke(main, [*asked, "--set", "plyas=3", "--set", "plyas=4"])
    assert said.exit_code == 2
    assert "given twice" in said.output


def test_an_effect_that_a_law_has_no_room_for_leaves_that_law_out():
    found = compare(Dataset(records(BOUC_WEN)), ("bouc-wen", "dahl"), ("eddy-current",), options=ONE)
    reasons = found.table.set_index("law")["reason"]
    assert reasons["bouc-wen"] == ""
    assert "no room for eddy-current" in reasons["dahl"]


def test_a_record_of_one_sample_is_told_and_one_of_three_is_fitted():
    whole = records(BOUC_WEN)[0]
    for alone in (compare, fit):
        with pytest.raises(UserError, match="one sample is no signal"):
            alone(Dataset((whole, whole.take(slice(0, 1), "short"))), *(("bouc-wen",) if alone is fit else ()))
    found = fit(Dataset((whole, whole.take(slice(0, 3), "short"))), "bouc-wen")
    assert set(found.records["record"]) >= {"run 0", "short"}


def test_where_no_loop_closes_no_law_is_believed_without_a_word():
    there = 0.5 - 0.5 * np.cos(np.pi * TIME)
    half, whole = (Record(TIME, u, BOUC_WEN(u), name=name) for u, name in ((there, "half"), (drive(1.0, 2.0), "whole")))
    assert OPEN in compare(Dataset((half,)), ("dahl",), options=ONE).words
    assert OPEN not in compare(Dataset((whole,)), ("dahl",), options=ONE).words


def test_a_smooth_law_behind_an_effect_that_is_not_affine_is_told():
    table = compare(Dataset(records(BOUC_WEN)), ["preisach-hats", "dahl"], ["saturation"], options=ONE).table
    assert "not linear in its many weights" in table.set_index("law").loc["preisach-hats", "reason"]
