"""The report: its numbers against hand-made ones, its words, its files, its pages."""

import io
import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from rich.console import Console

from hysteresis_bench import statistics
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.objective import Trace
from hysteresis_bench.report.paper.claims import FAILS, HOLDS, UNDECIDED, judge
from hysteresis_bench.report.paper.published import check_published
from hysteresis_bench.report.searches.looks import SHOWN, choose, floors
from hysteresis_bench.report.shared.text import number, percent, probability, to_its_error, whole
from hysteresis_bench.report.shared.theme import spread_labels
from hysteresis_bench.report.study import summarise, write_report
from hysteresis_bench.report.study.console import print_summary
from hysteresis_bench.report.study.words import answer, winners
from hysteresis_bench.report.trials.summary import at_iterations, problems
from hysteresis_bench.study.results import read_results
from hysteresis_bench.study.store import Outcome, Store
from tests.report.links import parsed
from tests.synthetic_study import OPTIMIZERS, PROBLEMS, write_results

LINEAR = PROBLEMS[0]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_results(tmp_path_factory.mktemp("results"))


@pytest.fixture(scope="module")
def results(folder):
    return read_results(folder)


@pytest.fixture(scope="module")
def page(folder, results):
    return write_report(folder).read_text(encoding="utf-8")


@pytest.fixture
def tiny(tmp_path):
    """Three trials of two optimizers whose every statistic is plain; one trial of mpso timed out."""
    write_results(tmp_path, trials=1)
    (tmp_path / "trials.sqlite").unlink()
    ends = {"pso": [4.0, 2.0, 3.0], "mpso": [1.0, 1.005, None]}
    with Store(tmp_path) as store:
        store.begin("tiny")
        for label, values in ends.items():
            for trial, end in enumerate(values):
                if end is None:
                    store.add(Outcome(LINEAR, label, trial, "0", "timed-out", "too slow"))
                    continue
                trace = Trace(np.array([1, 50, 100 * (trial + 1)]), np.array([9.0, 5.0, end]), np.ones((3, 1)))
                outcome = Outcome(
                    LINEAR, label, trial, "0", "done", "", 1000, end, end, end / 10, end / 5, 2 * end, 1.0
                )
                store.add(Outcome(**{**outcome.__dict__, "trace": trace}))
    return read_results(tmp_path)


def test_the_summary_is_what_one_counts_by_hand(tiny):
    rows = summarise(tiny).set_index("optimizer")
    assert list(rows.index) == ["mpso", "pso"]
    mpso, pso = rows.loc["mpso"], rows.loc["pso"]
    assert (pso["fitness_best"], pso["fitness_median"], pso["fitness_q1"], pso["fitness_q3"]) == (2.0, 3.0, 2.5, 3.5)
    assert (mpso["trials"], mpso["failed"], mpso["successes"]) == (3, 1, 2)
    assert (mpso["fitness_median"], mpso["fitness_q3"]) == (1.005, np.inf)
    assert mpso["evaluations_to_success_median"] == 200
    assert mpso["expected_running_time"] == (100 + 200 + 0) / 2
    assert pso["evaluations_to_success_median"] == np.inf
    assert mpso["a12_reference"] == pytest.approx(2 / 3)
    assert pd.isna(mpso["p_reference"])
    assert mpso["verdict_reference"] == statistics.TOO_FEW
    assert pso["verdict_reference"] == "is the reference"
    assert (mpso["success_low"], mpso["success_high"]) == statistics.wilson(2, 3)


def test_fitness_after_the_papers_iterations_is_read_from_the_traces(tiny):
    row = (
        at_iterations(tiny, problems(tiny, any_budget=True), 2).set_index("optimizer").loc["pso"]
    )  # 50 particles, 3 swarms: 150 evaluations
    assert row["evaluations"] == 150
    assert row["fitness_median"] == 5.0
    assert row["fitness_best"] == 4.0


def test_who_has_no_iterations_or_not_enough_budget_is_told(results):
    notes = (
        at_iterations(results, problems(results, any_budget=True), 300)
        .query("problem == @LINEAR")
        .set_index("optimizer")["note"]
    )
    assert notes["random-search"] == "has no iterations"
    assert notes["scipy-differential-evolution"] == "beyond the budget"
    assert notes["pso"] == ""


def test_the_best_known_to_twelve_digits_is_a_tie(tiny):
    [problem] = problems(tiny)
    problem.rows["pso"]["fitness"] = problem.best[1] * (1 + 1e-9)
    problem.rows["mpso"]["fitness"] = problem.best[1]
    problem.rows["mpso"]["status"] = "done"
    assert np.array_equal(problem.sample("pso").blocks, problem.sample("mpso").blocks)


def test_claims_hold_fail_or_cannot_be_told(results):
    def verdict(better, worse, metric="fitness"):
        claim = {"says": "x", "where": "y", "better": better, "worse": worse, "metric": metric}
        return judge(check_published({"claim": [claim]}), problems(results)[:1])[0]

    assert verdict("mpso", "pso").verdict == HOLDS
    assert verdict("pso", "mpso").verdict == FAILS
    assert verdict("pso", "random-search", "evaluations_to_success").verdict == UNDECIDED
    assert "was not run" in verdict("icpso", "pso").why


def test_with_few_trials_nothing_is_claimed(tmp_path):
    few = read_results(write_results(tmp_path, trials=3))
    judged = judge(check_published(few.published), problems(few))
    assert {found.verdict for found in judged} == {UNDECIDED}
    sentences = " ".join(answer(problems(few), summarise(few), judged))
    assert "cannot be judged on 3 trials" in sentences
    assert "apart from each of the other" not in sentences
    assert summarise(few)["p_best"].isna().all()


def test_those_who_cannot_be_told_apart_are_named(results):
    found = problems(results)[0]
    best = found.rows[found.winner]["fitness"].to_numpy()
    alike = {label: rows.assign(fitness=best, status="done") for label, rows in found.rows.items()}
    problem = replace(found, rows=alike)  # everybody as good as the winner
    tied = [label for label in problem.labels if label != problem.winner]
    [sentence] = winners([problem], summarise(results))
    assert "In this instance, we cannot tell it apart from" in sentence
    assert set(problem.tied_with_winner) == set(tied)


def test_few_are_drawn_and_the_reference_is_among_them(results):
    looks = choose(problems(results), "pso", ["pso", "mpso"], floor=floors(results.study))
    assert len(looks) <= SHOWN
    assert list(looks)[:2] == ["pso", "mpso"]
    assert {"random-search", problems(results)[0].winner} <= set(looks)
    assert len({look.colour for look in looks.values()}) == len(looks)


def test_the_page_has_every_section_and_needs_nothing_else(folder, page):
    links = parsed(page)
    for section in ("answer", "run", "published", "claims", "optimizers", "iterations", "searches", "signals",
                    "held-out", "determined", "audit", "decisions", "definitions"):  # fmt: skip
        assert section in links.ids
    assert "is left out" not in page
    assert not [source for source in links.sources if re.match(r"(?i)(https?:)?//|data:", source)]
    assert "<script src" not in page
    assert "url(http" not in page
    assert "@import" not in page
    for source in links.sources:
        target = source.removeprefix("#")
        assert target in links.ids if source.startswith("#") else (folder / source).is_file(), source
    assert len(links.ids) == len(set(links.ids))


def test_what_is_folded_away_says_what_it_is_and_is_open_on_paper(page):
    summaries = re.findall("<summary>(.*?)</summary>", page)
    assert "Show" not in summaries
    assert {"Show 11 terms", "Show the text"} & set(summaries)
    assert re.search(r"Show [0-9]+ tables", page)
    assert "beforeprint" in page


def test_what_a_study_says_is_text_not_markup(page):
    assert "&lt;b&gt;a test&lt;/b&gt;" in page
    assert "<b>a test</b>" not in page


def test_published_numbers_and_failures_stand_in_the_page(page):
    text = re.sub(r"<[^>]+>", " ", page)
    assert "30.84\u202f%" in text
    assert "22.53\u202f%" in text
    assert "8.074\u202f%" in text
    assert "unpublished" in text
    assert "stopped after 600 s" in text
    assert "not borne out" not in text


def test_what_the_data_cannot_tell_stands_in_the_page(page):
    text = re.sub(r"<[^>]+>", " ", page)
    assert "alpha cannot be told from these records." in text
    assert "4 of 5 directions" in text
    assert "more parameters than samples" in text
    assert "profile-1-1.svg" in page


def test_figures_follow_the_page_and_stand_alone_on_disk(folder, page):
    figures = sorted((folder / "figures").glob("*.svg"))
    assert len(figures) == page.count("<figure>")
    assert "var(--series-1)" in page
    assert all("var(--" not in figure.read_text() for figure in figures)
    assert all(figure.read_text().startswith("<?xml") for figure in figures)


def test_the_summary_file_is_the_table(folder, page, results):
    read = pd.read_csv(folder / "summary.csv")
    pd.testing.assert_frame_equal(read, summarise(read_results(folder)), check_dtype=False)
    assert set(read["optimizer"]) == set(OPTIMIZERS)


def test_a_report_leaves_its_main_tables_as_latex(folder, page):
    made = (folder / "tables.tex").read_text(encoding="utf-8")
    assert made.count(r"\begin{table}") == made.count(r"\end{table}") == 1 + len(PROBLEMS)
    assert all(made.count(f"\n{label} & ") == len(PROBLEMS) for label in OPTIMIZERS)
    assert not re.search(r"(?<!\\)%(?! needs)", made)


def test_the_same_results_give_the_same_report(folder, page):
    assert write_report(folder).read_text(encoding="utf-8") == page


def test_a_study_without_paper_and_without_failures_has_a_report_too(tmp_path):
    page = write_report(write_results(tmp_path, trials=2, published=False, fail=False)).read_text(encoding="utf-8")
    ids = parsed(page).ids
    assert "optimizers" in ids
    assert not {"published", "claims", "audit", "iterations"} & set(ids)


def test_a_study_where_everything_failed_has_a_report_too(tmp_path):
    write_results(tmp_path, trials=1)
    (tmp_path / "trials.sqlite").unlink()
    (tmp_path / "responses.csv").unlink()
    with Store(tmp_path) as store:
        store.begin("dead")
        for label in ("pso", "mpso"):
            store.add(Outcome(LINEAR, label, 0, "0", "crashed", "exit code 7"))
    page = write_report(tmp_path).read_text(encoding="utf-8")
    assert "every trial failed" in page
    assert "exit code 7" in page


def test_a_folder_without_trials_is_the_users_fault(tmp_path):
    write_results(tmp_path, trials=1)
    (tmp_path / "trials.sqlite").unlink()
    (tmp_path / "trials.csv").unlink()
    with pytest.raises(UserError, match="holds no trials"):
        write_report(tmp_path)


def test_a_faulty_published_file_is_the_users_fault(tmp_path):
    write_results(tmp_path, trials=1)
    (tmp_path / "published.toml").write_text("claims = []\n", encoding="utf-8")
    with pytest.raises(UserError, match="claims"):
        write_report(tmp_path)


def test_the_terminal_table_names_everybody(results):
    out = io.StringIO()
    print_summary(read_results(results.folder), Console(file=out, width=160))
    for label in OPTIMIZERS:
        assert label in out.getvalue()
    assert "14 failed" in out.getvalue()


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (number(3.296e-4), "3.296×10⁻⁴"),
        (number(1e-14, 7), "1×10⁻¹⁴"),
        (number(0.0823), "0.0823"),
        (number(2.2722e7, 7), "2.2722×10⁷"),
        (number(15050.0), "15\u202f050"),
        (number(12345.6), "12\u202f350"),
        (number(396130.4, 2), "400\u202f000"),
        (number(396130), "396\u202f130"),
        (number(5433.2), "5\u202f433"),
        (number(1.0), "1"),
        (number(1.00004), "1.000"),
        (number(0.1 + 0.2), "0.3"),
        (number(999999.7), "1.000×10⁶"),
        (number(3.2999996e-4), "3.300×10⁻⁴"),
        (to_its_error(0.30712, 0.0212), "0.307"),
        (to_its_error(238614.2, 2215.0), "238\u202f600"),
        (to_its_error(0.1, 2.9), "0.1"),
        (to_its_error(0.304225, 0.0), "0.304225"),
        (to_its_error(1.23456789, None), "1.235"),
        (to_its_error(1.23456789, float("inf")), "1.235"),
        (number(float("inf")), "failed"),
        (number(None), "–"),
        (number(float("nan")), "–"),
        (number(0.0), "0"),
        (whole(15050), "15\u202f050"),
        (whole(float("inf")), "not reached"),
        (percent(0.0807), "8.07\u202f%"),
        (probability(0.0004), "< 0.001"),
        (probability(0.0234), "0.023"),
    ],
)
def test_numbers_as_text(text, wanted):
    assert text == wanted


def test_labels_keep_their_distance_and_their_order():
    places = spread_labels([0.5, 0.5, 0.98, 0.0], 0.1)
    assert sorted(places) == [places[i] for i in (3, 0, 1, 2)]
    assert np.diff(sorted(places)).min() >= 0.1 - 1e-12
    assert max(places) <= 1.0
