"""benchmarks/torture.py, reduced: bad trials among good ones, and kills of the runner and of workers."""

import importlib.util
from pathlib import Path

import pytest

FILE = Path(__file__).parents[2] / "benchmarks" / "torture.py"


@pytest.fixture(scope="module")
def torture():
    spec = importlib.util.spec_from_file_location("torture", FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.long
def test_an_ill_treated_study_is_the_one_left_in_peace(torture, tmp_path):
    bench = torture.Bench(tmp_path, variants=1, trials=1, budget=1500, timeout=6.0)
    assert "24 trials, 16 bad ones of 16 kinds" in torture.bad_trials(bench)
    assert "SIGKILLs of the runner" in torture.runner_kills(bench, 2, longest=6.0)
    assert "SIGKILLs of workers" in torture.worker_kills(bench, 1, longest=1.0)
