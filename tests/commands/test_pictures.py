"""`predict --plot` and `control --reference` draw; pages open, or say where they are."""

import json
import os
import webbrowser
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main
from hysteresis_bench.fit.model_file import Estimate, FittedModel, write_model

VALUES = {"alpha": (0.35, "1"), "beta": (0.7, "1/V"), "gamma": (0.15, "1/V"), "d": (1.2, "um/V")}
MODEL = FittedModel(
    "bouc-wen",
    {"n": 1.0},
    (),
    {},
    {"time": "s", "input": "V", "output": "um"},
    {name: Estimate(value, None, unit) for name, (value, unit) in VALUES.items()},
)
ROWS = [f"{i / 100},{3 * np.sin(i / 9):.6f},{3 * np.sin(i / 9):.6f}" for i in range(120)]


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_model(tmp_path / "model.json", MODEL)
    (tmp_path / "loop.csv").write_text("time [s],input [V],output [um]\n" + "\n".join(ROWS), encoding="utf-8")
    return tmp_path


def told(*arguments, code=0):
    done = CliRunner().invoke(main, list(arguments))
    assert done.exit_code == code, done.output
    return " ".join(done.output.split())


def test_predict_draws_and_tells_the_error(here):
    said = told("predict", "model.json", "loop.csv", "--out", "p.csv", "--plot", "p.svg")
    assert "RMSE" in said
    assert "Predicted minus measured" in (here / "p.svg").read_text(encoding="utf-8")
    assert "Output (" in (here / "p.svg").read_text(encoding="utf-8")


def test_predict_draws_what_was_not_measured(here):
    table = pd.read_csv("loop.csv")
    table.drop(columns="output [um]").to_csv("drive.csv", index=False)
    told("predict", "model.json", "drive.csv", "--out", "p.csv", "--plot", "p.svg")
    assert "Predicted" in (here / "p.svg").read_text(encoding="utf-8")


def test_measure_draws_what_it_took(here):
    assert "figure: m.pdf" in told("measure", "pea", "ramp", "--out", "m.csv", "--plot", "m.pdf")
    assert (here / "m.pdf").read_bytes().startswith(b"%PDF")


def test_control_draws_tracking(here):
    said = told("control", "model.json", "--reference", "loop.csv", "--out", "c")
    assert "figure: c/tracking.svg" in said
    assert "wanted" in (here / "c" / "tracking.svg").read_text(encoding="utf-8")
    told("control", "model.json", "--reference", "loop.csv", "--out", "c", "--plot", "t.pdf")
    assert (here / "t.pdf").read_bytes().startswith(b"%PDF")
    assert "--plot draws what --reference or --sweep makes" in told(
        "control", "model.json", "--rig", "pea", "--plot", "x.png", code=2
    )


@pytest.mark.parametrize("command", ["check", "fit", "diagnose", "compare", "predict"])
def test_another_kind_of_figure_is_refused_before_the_work(here, command):
    model = {"predict": ("model.json",)}.get(command, ())
    made = {"fit": ("--model", "polynomial"), "predict": ("--out", "p.csv")}.get(command, ())
    assert "x.jpg: a figure is one of .pdf, .svg, .png." in told(
        command, *model, "loop.csv", *made, "--plot", "x.jpg", code=2
    )


def test_where_nothing_can_be_written_is_told_before_the_work(here, monkeypatch):
    fit = ("fit", "loop.csv", "--model", "polynomial", "--out")
    assert "loop.csv is no folder" in told(*fit, "loop.csv/fit", code=2)
    monkeypatch.setattr(os, "access", lambda path, mode, **_: mode & os.W_OK == 0)
    for command in (fit, ("control", "model.json", "--sweep", "1", "--out")):
        assert "is read-only. Choose another place with --out." in told(*command, "new/place", code=2)
    assert "is read-only" in told("predict", "model.json", "loop.csv", "--out", "p.csv", code=2)


def test_a_reference_without_names_or_time(here):
    (here / "bare.txt").write_text("\n".join(f"{np.sin(i / 9):.6f}" for i in range(120)), encoding="utf-8")
    refused = told("control", "model.json", "--reference", "bare.txt", "--out", "b", code=2)
    assert "only 1 column" in refused
    command = ("control", "model.json", "--reference", "bare.txt", "--output", "1", "--rate", "100", "--out", "b")
    told(*command)
    assert pd.read_csv(here / "b" / "feed-forward.csv").iloc[-1, 0] == 1.19
    ranges = {"ranges": {"input": [-0.5, 0.5]}}
    write_model(here / "model.json", replace(MODEL, data=ranges))
    assert "need an input beyond the fitted ones (-0.5 to 0.5)" in told(*command)


def test_control_tells_a_program(here):
    command = ("control", "model.json", "--reference", "loop.csv", "--voltage-limit", "0.5", "--out", "c", "--json")
    found = json.loads(CliRunner().invoke(main, list(command)).stdout)
    cut = pd.read_csv(here / found["feed_forward"])["at_limit"]
    assert (found["samples"], found["at_limit"]) == (cut.size, cut.sum())
    assert found["at_limit"] > 0
    assert (here / found["figure"]).is_file()
    assert "one of them alone" in told(*command, "--sweep", "1", code=2)


@pytest.mark.parametrize("found", [True, False])
def test_a_page_is_opened_or_told(here, monkeypatch, found):
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) or found)
    said = told("fit", "loop.csv", "--model", "polynomial", "--budget", "60", "--open")
    assert opened[0].endswith("loop-fit/fit.html")
    assert ("No browser was found" in said) is not found
