"""Laws that the data exclude are not fitted, and it is said; a law that is named is."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench import compare, fit, registry
from hysteresis_bench.cli import main
from hysteresis_bench.data.data_files import write_csv
from hysteresis_bench.diagnosis.evidence.view import View
from hysteresis_bench.diagnosis.laws.exclusion import excluded, why_not
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.diagnosis.structure.structure import structure
from hysteresis_bench.signals import Dataset
from tests.conftest import forget_plugins
from tests.diagnosis.structure.made import coleman_hodgdon, modulated, plays, seen, sine

ONE = DiagnosisOptions(jobs=1)


def clockwise(time: np.ndarray, u: np.ndarray) -> np.ndarray:
    """A spring beside friction: what the input gains and the plays do not."""
    return u - 0.2 * plays()(time, u)


def dataset(views: tuple[View, ...]) -> Dataset:
    return Dataset(tuple(view.record for view in views))


@pytest.fixture
def few(monkeypatch):
    """Two of the registered laws, so that fitting them all takes no time."""
    whole = registry.names
    named = ("dahl", "energy-based")
    monkeypatch.setattr(registry, "names", lambda kind: named if kind == "models" else whole(kind))
    yield
    forget_plugins()  # what these two offer


def test_loops_exclude_a_law_that_runs_the_other_way(few):
    found = compare(dataset(seen(clockwise, sine)), options=ONE)
    reasons = found.table.set_index("law")["reason"]
    assert reasons["dahl"] == ""
    assert "excluded: the loops run clockwise" in reasons["energy-based"]
    named = compare(dataset(seen(clockwise, sine)), ("energy-based",), options=ONE)
    assert "excluded" not in named.table.set_index("law")["reason"]["energy-based"]


def test_branches_exclude_a_law_of_masings_rule_where_no_effect_may_follow():
    found = structure(seen(coleman_hodgdon(alpha=1.5), modulated, level=0.001))
    least = found.of("Masing's rule").least
    names = ("prandtl-ishlinskii", "preisach", "bouc-wen")
    assert set(excluded(names, found, 0.9 * least, alone=True)) == {"prandtl-ishlinskii"}
    assert not excluded(names, found, 1.1 * least, alone=True)
    assert not excluded(names, found, 0.9 * least, alone=False)


def test_what_a_lag_may_blur_excludes_nothing():
    def late(time, u):
        return coleman_hodgdon(alpha=1.5)(time, np.interp(time - 0.1, time, u))

    found = structure(seen(late, modulated, level=0.001))
    assert found.of("rate independence").refutes
    assert not excluded(("prandtl-ishlinskii",), found, 0.0, alone=True)


def test_the_reason_why_a_law_cannot_follow_is_that_of_its_own_properties():
    found = structure(seen(coleman_hodgdon(alpha=1.5), modulated, level=0.001))
    moved = 0.01 * found.of("Masing's rule").statistic * found.span
    assert "Masing's rule" in why_not("prandtl-ishlinskii", found, 2.0 * moved)
    assert "Masing's rule" not in why_not("prandtl-ishlinskii", found, 20.0 * moved)
    assert "Masing's rule" not in why_not("bouc-wen", found, 2.0 * moved)


def test_a_fit_far_above_the_noise_says_that_the_law_cannot_follow():
    views = seen(coleman_hodgdon(alpha=1.5), modulated, level=0.001)
    told = " ".join(fit(dataset(views), "prandtl-ishlinskii").warnings)
    assert "cannot follow these data" in told
    assert "branches from different reversals differ" in told.lower()
    own = seen(plays(np.linspace(0.1, 0.8, 8), 0.3), modulated, level=0.01)
    assert "cannot follow" not in " ".join(fit(dataset(own), "prandtl-ishlinskii").warnings)


def test_an_output_of_nothing_but_noise_does_not_follow_the_input():
    view = seen(plays(), sine)[0]
    noise = np.random.default_rng(4).standard_normal(view.record.time.size)
    told = fit(Dataset((replace(view.record, output=noise),)), "prandtl-ishlinskii").warnings
    assert any("The output does not follow the input" in one for one in told)
    assert not any("does not follow the input" in one for one in fit(dataset([view]), "prandtl-ishlinskii").warnings)


def test_loops_of_both_senses_are_told():
    one = seen(plays(), sine)[0].record
    other = replace(seen(clockwise, sine)[0].record, name="other")
    found = compare(Dataset((one, other)), ("dahl",), options=ONE)
    assert found.chosen == ""
    assert "loops run clockwise in other and anticlockwise in run 0" in found.words
    told = " ".join(fit(Dataset((one, other)), "dahl").warnings)
    assert "cannot follow these data" in told
    assert "anticlockwise in run 0" in told


def test_the_page_and_the_json_tell_the_structure(tmp_path):
    paths = []
    for view in seen(clockwise, sine, samples=300):
        paths.append(tmp_path / f"{view.record.name.replace(' ', '')}.csv")
        write_csv(paths[-1], Dataset((view.record,)))
    asked = ["compare", *map(str, paths), "--models", "dahl", "--jobs", "1", "--out", str(tmp_path / "laws"), "--json"]
    said = CliRunner().invoke(main, asked)
    assert said.exit_code == 0, said.output
    told = {row["test"]: row for row in json.loads(said.stdout)["structure"]}
    assert told["sense"]["statistic"] < 0.0
    assert told["congruency"]["applies"] is False
    page = (tmp_path / "laws" / "laws.html").read_text()
    assert "What the data say before any fit" in page
    assert "loops run clockwise" in page
