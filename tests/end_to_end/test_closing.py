"""A study that closes its loop: the diagnosis after the trials, its files, and the report's last section."""

import json
import re
import shutil
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner, Result

from hysteresis_bench.cli import main
from hysteresis_bench.kernels.lag import lag
from hysteresis_bench.report.diagnosis.in_print import in_print
from hysteresis_bench.report.shared.text import number
from hysteresis_bench.study.study_file import check_study, read_study
from hysteresis_bench.study_diagnosis import ClosingTicket, asked_for, run_closing
from tests.end_to_end.test_run import run_command

STUDIES = Path(__file__).parents[2] / "studies"
LAG = 0.05

STUDY = """
title = "A cubic that lags"
seed = 7
trials = 1
budget = 100
[[problem]]
name = "cubic"
model = "polynomial"
data = ["lagging.csv"]
fitted = ["lagging:slow"]
[[optimizer]]
plugin = "pso"
[closing]
model = "polynomial"
fitted = ["lagging:slow", "lagging:fast"]
held_out = ["lagging:middle"]
says = "A <lag> is not considered."
"""


def write(folder: Path) -> Path:
    """A cubic behind a first-order lag, at three speeds, with a little noise."""
    rng = np.random.default_rng(1)
    parts = []
    for name, frequency in (("slow", 0.5), ("fast", 3.0), ("middle", 1.5)):
        time = np.linspace(0.0, 2.0, 240)
        drive = np.sin(2 * np.pi * frequency * time)
        late = lag(time, drive[:, None], np.array([LAG]))[:, 0]
        output = late + 0.5 * late**3 + 0.005 * rng.standard_normal(time.size)
        parts.append(pd.DataFrame({"run": name, "time [s]": time, "input [V]": drive, "output [um]": output}))
    pd.concat(parts).to_csv(folder / "lagging.csv", index=False)
    path = folder / "closed.toml"
    path.write_text(STUDY, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def closed(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("closed")
    done = run_command("run", write(folder), "--jobs", 1)
    assert done.returncode == 0, done.stderr + done.stdout
    assert "Closing the loop: " in done.stdout
    return folder / "runs" / "closed"


def section(results: Path) -> str:
    page = (results / "report.html").read_text(encoding="utf-8")
    return page[page.index('<section id="closing">') :].split("</section>")[0]


def report(results: Path) -> Result:
    return CliRunner().invoke(main, ["report", str(results)], catch_exceptions=False)


def test_the_report_ends_with_what_was_found(closed):
    told = json.loads((closed / "closing" / "diagnosis.json").read_text(encoding="utf-8"))
    assert told["after"]["held_out"]["rmse"] < 0.2 * told["before"]["held_out"]["rmse"]
    assert told["split"]["held_out"] == ["lagging:middle"]
    text = section(closed)
    assert in_print(told["headline"].split(". ")[0]) in text
    assert "A &lt;lag&gt; is not considered." in text
    for stage in ("before", "after"):
        for role in ("fitted", "held_out"):
            row = rf"{role.replace('_', ' ')}, {stage}</th>\s*<td[^>]*>{re.escape(number(told[stage][role]['rmse']))}<"
            assert re.search(row, text), (stage, role)
    assert re.search(rf"noise</th>\s*<td[^>]*>{re.escape(number(told['noise_rms']))}<", text)
    assert all(f"{tie['effect']} and {tie['rival']}" in text for tie in told["ties"])
    assert 'href="closing/diagnosis.html"' in text
    for name in ("closing/model.json", "closing/diagnosis.html", "figures/closing-waterfall.svg"):
        assert (closed / name).is_file(), name
    assert text.count("<svg") == 5


def test_the_report_is_written_again_without_a_diagnosis(closed, monkeypatch):
    before = (closed / "report.html").read_bytes()
    monkeypatch.setattr("hysteresis_bench.study_diagnosis.diagnose", lambda *_, **__: pytest.fail("diagnosed"))
    monkeypatch.setattr("hysteresis_bench.diagnosis.diagnose.diagnose", lambda *_, **__: pytest.fail("diagnosed"))
    assert report(closed).exit_code == 0
    assert (closed / "report.html").read_bytes() == before


def test_the_same_diagnosis_is_kept(closed):
    file = closed / "closing" / "diagnosis.json"
    made = file.stat().st_mtime_ns
    study = closed.parents[1] / "closed.toml"
    study.write_text(STUDY.replace("<lag>", "delay"), encoding="utf-8")
    assert run_command("run", study, "--jobs", 1).returncode == 0
    assert file.stat().st_mtime_ns == made
    assert "A delay is not considered." in section(closed)


def test_one_process_or_two_give_the_same_diagnosis(closed, tmp_path):
    study = read_study(write(tmp_path))[0].model_dump_json()
    assert run_closing(ClosingTicket(study, str(tmp_path), str(tmp_path), jobs=2)).status == "done"
    for name in ("diagnosis.json", "model.json", "responses.csv"):
        assert (tmp_path / name).read_bytes() == (closed / "closing" / name).read_bytes(), name


def test_a_diagnosis_that_failed_is_told(closed, tmp_path):
    study = write(tmp_path)
    data = pd.read_csv(tmp_path / "lagging.csv")
    data.loc[data["run"] == "fast", "output [um]"] = 1.0
    data.to_csv(tmp_path / "lagging.csv", index=False)
    ended = run_closing(ClosingTicket(read_study(study)[0].model_dump_json(), str(tmp_path), str(tmp_path)))
    assert ended.status == "raised"
    assert "lagging:fast: the output is constant" in ended.reason
    results = shutil.copytree(closed, tmp_path / "results")
    shutil.rmtree(results / "closing")
    (results / "closing").mkdir()
    told = {"asked": {}, "hidden": [], "status": ended.status, "reason": ended.reason, "seconds": 1.0}
    (results / "closing" / "closing.json").write_text(json.dumps(told), encoding="utf-8")
    assert report(results).exit_code == 0
    assert "lagging:fast: the output is constant" in section(results)
    assert "<table" not in section(results)


def test_an_unknown_record_is_told_before_the_trials(tmp_path):
    study = write(tmp_path)
    study.write_text(STUDY.replace("lagging:middle", "lagging:midle"), encoding="utf-8")
    done = run_command("run", study)
    assert done.returncode == 2
    assert 'no record "lagging:midle"' in done.stderr
    assert not (tmp_path / "runs").exists()


def test_words_do_not_make_it_another_diagnosis():
    raw = tomllib.loads(STUDY)
    same = check_study({**raw, "closing": {**raw["closing"], "says": "", "after": "cubic"}}, "t")
    assert asked_for(same) == asked_for(check_study(raw, "t"))
    assert asked_for(check_study({**raw, "seed": 8}, "t")) != asked_for(same)
    known = {**raw["closing"], "effects": ["input-lag"]}
    assert asked_for(check_study({**raw, "closing": known}, "t")) != asked_for(same)


@pytest.mark.parametrize("name", ["sma", "pea", "gma"])
def test_the_papers_studies_close_their_loops(name):
    closing = read_study(STUDIES / f"{name}.toml")[0].closing
    assert closing is not None
    assert closing.says
    assert not set(closing.fitted) & set(closing.held_out)
