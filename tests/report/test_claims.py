"""Claims over instances: verdicts that hold beyond one, ties by rounding, searches that never arrive."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench import statistics
from hysteresis_bench.report.paper.claims import (
    EQUIVALENT,
    FAILS,
    HOLDS,
    NEVER,
    UNDECIDED,
    in_words,
    judge,
    sentences,
    table,
)
from hysteresis_bench.report.paper.claims_file import write_claims
from hysteresis_bench.report.paper.published import check_published
from hysteresis_bench.report.searches.against_time import curve
from hysteresis_bench.report.shared.text import NONE
from hysteresis_bench.report.trials.best_known import best_known
from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.report.trials.summary import _successes
from hysteresis_bench.report.trials.targets import section

RNG = np.random.default_rng(3)


def problem(factors, instances=20, trials=2, noise=0.02, name="p"):
    """Optimizers whose errors are these factors times the difficulty of an instance."""
    difficulty = np.exp(RNG.normal(0.0, 1.0, instances))
    rows, traces = {}, {}
    for label, factor in factors.items():
        keys = [(instance, trial) for instance in range(1, instances + 1) for trial in range(trials)]
        error = np.array([factor * difficulty[i - 1] for i, _ in keys]) * np.exp(noise * RNG.standard_normal(len(keys)))
        frame = pd.DataFrame(keys, columns=["instance", "trial"])
        columns = {"fitness": 7 * error**2, "relative_rms": error, "max_error": 3 * error, "evaluations": 100}
        rows[label] = frame.assign(**columns, status="done", optimizer=label)
        for key, fitness in zip(keys, rows[label]["fitness"], strict=True):
            traces[label, *key] = np.array([1, 100]), np.array([9 * fitness, fitness])
    return Problem(name, list(factors), rows, traces, "pso", best_known(pd.concat(rows.values())))


def judged(here, metric="fitness", ablation=False):
    claim = {"says": "new beats pso", "where": "Table 1", "better": "new", "worse": "pso", "metric": metric}
    [found] = judge(check_published({"claim": [claim | {"ablation": ablation}]}), [here])
    return found


@pytest.mark.parametrize(("factor", "verdict"), [(0.8, HOLDS), (1.3, FAILS)])
def test_a_claim_is_judged_over_instances(factor, verdict):
    found = judged(problem({"pso": 1.0, "new": factor}))
    assert (found.verdict, found.over) == (verdict, "20 instances")
    assert "in this instance" not in sentences([found])[0]


def test_with_one_instance_the_verdict_is_of_this_instance():
    found = judged(problem({"pso": 1.0, "new": 0.8}, instances=1, trials=30))
    assert (found.verdict, found.over) == (HOLDS, "30 trials")
    assert "this holds in this instance" in sentences([found])[0]
    assert "in this instance (30 trials)" in in_words([found])


def test_rounding_is_no_difference():
    here = problem({"pso": 1.0, "new": 1.0}, noise=0.0)
    here.rows["new"]["max_error"] = here.rows["pso"]["max_error"] * (1 - 1e-7)
    found = judged(here, "max_error")
    assert (found.verdict, found.p, found.a12) == (EQUIVALENT, 1.0, 0.5)


def test_less_than_one_per_cent_makes_no_difference_however_sure():
    found = judged(problem({"pso": 1.0, "new": 0.997}, noise=1e-4))
    assert found.p < 0.01
    assert found.verdict == EQUIVALENT
    assert "make" in in_words([found])


def test_nobody_is_faster_where_nobody_arrives():
    here = problem({"pso": 2.0, "new": 3.0, "best": 1.0}, noise=0.001)
    found = judged(here, "evaluations_to_success")
    assert found.verdict == UNDECIDED
    assert found.why.startswith("neither comes")
    row = dict(zip((shown := table([found])).header, shown.cells[0], strict=True))
    assert (row["Here"].text, row["Equivalent"].text) == (NEVER, NONE)
    assert in_words([found]).endswith("1 cannot be told, because neither of the two comes to the best known.")


def test_a_claim_that_is_contradicted_is_named_and_called_what_the_table_calls_it():
    found = judged(problem({"pso": 1.0, "new": 1.3}))
    told = in_words([found])
    assert f"1 {FAILS}, as the contrary does: “new beats pso” (on p)" in told
    assert "contradicted" not in told


def test_a_table_says_how_its_interval_and_its_p_are_read():
    note = table([judged(problem({"pso": 1.0, "new": 0.8}))]).note
    assert "its interval is of this claim alone" in note
    assert "Equivalent is –" in note


def test_the_verdicts_are_kept_for_other_programs(tmp_path):
    found = judged(problem({"pso": 1.0, "new": 0.8}))
    write_claims(tmp_path, [found])
    [row] = pd.read_csv(tmp_path / "claims.csv").to_dict("records")
    assert (row["verdict"], row["over"], row["a12"]) == (HOLDS, "20 instances", found.a12)
    never = judged(problem({"pso": 2.0, "new": 3.0, "best": 1.0}, noise=0.001), "evaluations_to_success")
    write_claims(tmp_path, [never])
    assert pd.read_csv(tmp_path / "claims.csv")["verdict"][0] == UNDECIDED
    assert row["a12_low"] <= row["a12"] <= row["a12_high"]
    chances = [row[f"probability_{side}"] for side in ("better", "equivalent", "worse")]
    assert sum(chances) == pytest.approx(1.0)


def test_where_the_test_and_a12_are_at_odds_it_is_said_once():
    found = judged(problem({"pso": 1.0, "new": 0.8}))
    at_odds = replace(found, verdict=UNDECIDED, why=statistics.AT_ODDS)
    assert sentences([at_odds]) == [f"The paper says: new beats pso. Here, on “p” {statistics.AT_ODDS}."]


def test_an_ablation_is_asked_by_us_and_left_out_where_it_was_not_run():
    asked = judged(problem({"pso": 1.0, "new": 0.8}), ablation=True)
    assert sentences([asked])[0].startswith("We asked whether this holds: new beats pso.")
    assert in_words([asked]) == ""
    claim = {"says": "x", "where": "y", "better": "a", "worse": "b", "metric": "fitness", "ablation": True}
    assert judge(check_published({"claim": [claim]}), [problem({"pso": 1.0})]) == []


def test_statistics_are_hidden_below_enough_instances():
    few = judged(problem({"pso": 1.0, "new": 0.5}, instances=5))
    assert "p" not in table([few]).header
    assert "p" in table([judged(problem({"pso": 1.0, "new": 0.5}))]).header


def test_a_problem_of_few_trials_is_told_beside_those_that_are_tested_and_takes_no_row():
    tried = judged(problem({"pso": 1.0, "new": 0.8}, instances=1, trials=30, name="much"))
    few = judged(problem({"pso": 1.0, "new": 1.3}, instances=1, trials=3, name="little"))
    shown = table([few, tried])
    assert [row[1] for row in shown.rows] == ["much"]
    few_trials = "Not tested, as 14 instances, or trials of one instance, are needed: “little” (3 trials)."
    assert shown.note.startswith(few_trials)
    assert "little" not in in_words([few, tried]) + sentences([few, tried])[0]


def test_a_deterministic_optimizer_is_counted_once_an_instance():
    here = problem({"pso": 1.0, "new": 1.0})
    here.rows["new"]["fitness"] = here.rows["new"].groupby("instance")["fitness"].transform("first")
    assert here.repeats_itself("new")
    assert not here.repeats_itself("pso")
    assert (_successes(here, "new")["counted"], _successes(here, "pso")["counted"]) == (20, 40)


def test_success_is_counted_against_the_best_of_the_whole_study():
    """Also where another budget found it."""
    here = problem({"pso": 1.0, "new": 1.0}, noise=0.0)
    longer = pd.concat(here.rows.values()).assign(optimizer="longer", fitness=lambda rows: 0.5 * rows["fitness"])
    known = best_known(pd.concat([*here.rows.values(), longer]))
    alone = Problem("p", here.labels, here.rows, here.traces, "pso", known)
    assert _successes(here, "pso")["successes"] == 20  # without noise it repeats itself
    assert _successes(alone, "pso")["successes"] == 0


def test_other_targets_and_budgets_are_what_one_counts_by_hand():
    here = problem({"pso": 1.0, "new": 1.0}, instances=2, trials=2, noise=0.0)
    here.rows["pso"]["fitness"] *= 1.02
    for key in here.keys("pso"):
        here.traces["pso", *key][1][1] *= 1.02
    [rows] = [block.rows for block in section([here], 100).blocks if not isinstance(block, str)]
    found = {row[0]: row[1:] for row in rows}
    areas = {label: found[label].pop() for label in found}
    assert found["new"] == ["100\u202f%"] * 4 + ["100"] * 3 + ["9"] * 2 + ["1"]
    assert found["pso"] == ["0\u202f%"] * 2 + ["100\u202f%"] * 2 + ["not reached", "100", "100", "9", "9", "1.02"]
    # nine times the best known up to the last of the 200 points on the curve
    assert float(areas["new"]) == pytest.approx((199 * (1 - np.log10(9)) + 1) / 200, abs=1e-3)
    assert float(areas["pso"]) < float(areas["new"])


def test_quality_against_time_spreads_a_trial_over_its_evaluations():
    here = problem({"pso": 1.0, "new": 1.0}, instances=2, trials=2, noise=0.0)
    here.rows["pso"]["seconds"] = 4.0
    seconds, ratios = curve(here, "pso")
    assert (seconds[0], seconds[-1]) == (pytest.approx(0.04), pytest.approx(4.0))
    assert (ratios[0], ratios[-1]) == (pytest.approx(9.0), 1.0)
    here.rows["new"]["seconds"] = np.nan
    assert np.isnan(curve(here, "new")[0]).all()


def test_an_optimizer_that_has_fewer_instances_is_compared_on_those():
    here = problem({"pso": 1.0, "new": 0.8}, instances=3, trials=20)
    here.rows["new"] = here.rows["new"][here.rows["new"]["instance"] == 1]
    assert (here.several, here.counted) == (False, "20 trials")
    assert [side.size for side in here.sample("pso").instances] == [20]
    assert judged(here).over == "20 trials"
