"""A command that was killed goes on where it was, and ends in the same files."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from hysteresis_bench.commands.data.journal import ANSWERS, Journal, digest, journal
from hysteresis_bench.commands.outputs import UNFINISHED
from hysteresis_bench.diagnosis.doubt.other_laws import Contender
from hysteresis_bench.diagnosis.hypotheses.hypothesis import Behind, Hypothesis
from hysteresis_bench.diagnosis.hypotheses.workers import Workers
from hysteresis_bench.diagnosis.laws.law import Law
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.objective import Objective
from tests.conftest import ROOT

CPU_TIME = re.compile(r'"seconds": [0-9.e-]+|(?<=,)[0-9.e-]+(?=,[^,]*$)', re.MULTILINE)
"""What a law cost, in diagnosis.json and laws.csv: the only number that no two runs share."""
KILLED = """
import os, signal, sys
from hysteresis_bench.cli import main
from hysteresis_bench.commands.data.journal import Journal

def noted(self, question, answer, known=Journal.__setitem__):
    known(self, question, answer)
    if len(self._answers) == int(sys.argv[1]):
        os.kill(os.getpid(), signal.SIGKILL)
Journal.__setitem__ = noted
main(sys.argv[2:])
"""


def hypothesis(rmse=0.1):
    wave = rmse * np.sin(np.arange(50.0))
    return Hypothesis(frozenset({"bias", "creep"}), {"d": 0.1 + 0.2, "a": 1e-300}, wave, -wave, ("d",))


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A curve of a delayed input, and one of the input itself, in the folder that we are in. They need no other law,
    no past before they begin, nor, noisy as they are, more steps than samples: all that would take long."""
    monkeypatch.chdir(tmp_path)
    t, noise = np.arange(240) / 60.0, np.random.default_rng(2).standard_normal(240)
    for name, delay, size in (("loop", 0.06, 0.01), ("curve", 0.0, 0.02)):
        u, late = ((1.0 - np.cos(2 * np.pi * s)) * (0.5 + s / 8.0) for s in (t, np.maximum(t - delay, 0.0)))
        rows = zip(t, u, late + 0.2 * late**3 + size * noise, strict=True)
        lines = [",".join(f"{value:.6f}" for value in row) for row in rows]
        (tmp_path / f"{name}.csv").write_text("time,input,output\n" + "\n".join(lines) + "\n", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    ("asked", "after", "file"),
    [
        ("diagnose loop.csv --model polynomial --jobs 1", 12, "diagnosis.json"),
        pytest.param(
            "diagnose curve.csv --models polynomial,dahl --jobs 1", 6, "diagnosis.json", marks=pytest.mark.long
        ),
        pytest.param("compare loop.csv --models polynomial,dahl,lugre --jobs 1", 2, "laws.csv", marks=pytest.mark.long),
        ("fit loop.csv --model polynomial --seed 3", 1, "model.json"),
    ],
)
def test_killed_halfway_it_ends_in_the_same_file(here, monkeypatch, asked, after, file):
    searches = []

    def counted(self, *arguments, known=Objective.__init__, **named):
        searches.append(arguments)
        known(self, *arguments, **named)

    monkeypatch.setattr(Objective, "__init__", counted)
    command = [*asked.split(), "--out"]
    whole = CliRunner().invoke(main, [*command, "whole"])
    assert whole.exit_code == 0, whole.output
    needed, searches[:] = len(searches), []

    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(ROOT), str(ROOT / "tests" / "test_plugins")))}
    killed = [sys.executable, "-c", KILLED, str(after), *command, "killed"]
    assert subprocess.run(killed, env=environment, capture_output=True, check=False).returncode == -9
    assert sorted(path.name for path in (here / "killed").iterdir()) == [UNFINISHED]

    again = CliRunner().invoke(main, [*command, "killed"])
    assert again.exit_code == 0, again.output
    assert f"Used of a run that was stopped: {after} fit" in " ".join(again.output.split())
    assert 0 < needed - len(searches) < needed
    ended, never = (CPU_TIME.sub("", (here / out / file).read_text(encoding="utf-8")) for out in ("killed", "whole"))
    assert ended == never
    assert sorted(p.name for p in (here / "killed").iterdir()) == sorted(p.name for p in (here / "whole").iterdir())


def test_stopped_while_it_writes_its_page_it_may_write_over_what_it_had_written(here, monkeypatch):
    with monkeypatch.context() as stopping:

        def stopped(*_):
            raise KeyboardInterrupt

        stopping.setattr("hysteresis_bench.report.fit.folder.write_fit_page", stopped)
        CliRunner().invoke(main, ["fit", "loop.csv", "--model", "polynomial"])
    assert {"model.json", UNFINISHED} <= {path.name for path in (here / "loop-fit").iterdir()}
    again = CliRunner().invoke(main, ["fit", "loop.csv", "--model", "polynomial"])
    assert again.exit_code == 0, again.output
    assert UNFINISHED not in {path.name for path in (here / "loop-fit").iterdir()}


def test_stopped_by_ctrl_c_it_says_what_is_kept(here, monkeypatch):
    def stopped(self, question, answer, known=Journal.__setitem__):
        known(self, question, answer)
        if len(self._answers) == 3:
            raise KeyboardInterrupt

    monkeypatch.setattr(Journal, "__setitem__", stopped)
    done = CliRunner().invoke(main, ["diagnose", "loop.csv", "--model", "polynomial", "--jobs", "1"])
    assert done.exit_code == 130
    told = " ".join(done.output.split())
    assert f"3 finished fits are kept in loop-diagnosis/{UNFINISHED}. Run it again to continue." in told


def test_answers_come_back_to_the_last_bit(tmp_path):
    known = hypothesis()
    law = Law("dahl", "", 0.1 + 0.2, np.nan, np.arange(3.0) / 7.0, 5, 1.5, found=known)
    kept = Journal(tmp_path / UNFINISHED, "of")
    kept["a", known], kept["b", 1.0] = known, law
    again = Journal(tmp_path / UNFINISHED, "of")
    found, found_law = again.get(("a", known)), again.get(("b", 1.0))
    assert (found.names, found.values, found.at_bound) == (known.names, known.values, known.at_bound)
    assert np.array_equal(found.residuals, known.residuals)
    assert np.array_equal(found_law.unseen, law.unseen)
    assert found_law.found.values == known.values
    assert (found_law.fitted, found_law.parameters) == (law.fitted, law.parameters)
    assert np.isnan(found_law.held_out)
    assert again.get(("a", hypothesis(0.2))) is None


def test_what_was_left_behind_comes_back_as_that(tmp_path):
    """The same system is asked of again within one run, as of records that are read otherwise."""
    wave = np.sin(np.arange(50.0))
    kept = Journal(tmp_path / UNFINISHED, "of")
    kept["a",] = Behind(frozenset({"bias"}), {"d": 0.3}, wave, wave, ())
    assert isinstance(kept.get(("a",)), Behind)


def test_every_kind_of_answer_is_known():
    def every(kind):
        return {kind, *(below for one in kind.__subclasses__() for below in every(one))}

    assert {*ANSWERS.values()} == every(Hypothesis) | every(Law) | every(Contender)


def test_what_is_damaged_is_told_and_fitted_again(tmp_path):
    kept = Journal(tmp_path / UNFINISHED, "of")
    kept["a",], kept["b",] = hypothesis(), hypothesis(0.3)
    text = kept.path.read_text(encoding="utf-8")
    kept.path.write_text(text[:-20], encoding="utf-8")  # killed while it wrote
    again = Journal(kept.path, "of")
    assert again.known == 1
    assert "1 of 2 lines are damaged" in again.notes[1]
    again["b",] = hypothesis(0.3)
    assert Journal(kept.path, "of").known == 2

    other = Journal(kept.path, "of other data")
    assert other.known == 0
    assert "is of other data, other options or another version" in other.notes[0]
    other["c",] = hypothesis()
    assert Journal(kept.path, "of other data").known == 1


def test_a_question_that_is_refused_leaves_nothing(tmp_path):
    def refused():
        with journal(tmp_path / "out", 1) as kept:
            kept["a",] = hypothesis()
            raise UserError("diagnose", "no law can be fitted.")

    with pytest.raises(UserError):
        refused()
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("jobs", [1, 2])
def test_workers_ask_what_is_kept_first(tmp_path, jobs):
    kept, told = Journal(tmp_path / UNFINISHED, "of"), []
    fitter = Squares()
    kept[fitter, "square", 2.0] = 4.5
    with Workers(fitter, jobs, lambda step: told.append(step.done), kept) as workers:
        assert workers.map([("square", 1.0), ("square", 2.0), ("square", 3.0)]) == [1.0, 4.5, 9.0]
        assert workers.map([("square", 3.0)]) == [9.0]
    assert told == [1, 2, 3, 1]
    assert kept.get((fitter, "square", 1.0)) == 1.0


class Squares:
    def square(self, x):
        return x * x


def test_a_digest_tells_contents_apart():
    record = np.arange(3.0)
    assert digest((record, {"n": 1})) == digest((record.copy(), {"n": 1}))
    assert digest(frozenset("abcdef")) == digest(frozenset("fedcba"))
    different = [record, np.nextafter(record, 9.0), record[:2], {"n": 1}, {"n": 1.0}, {"n": True}, ("n", 1), len, max]
    assert len(set(map(digest, different))) == len(different)
