"""The index of kept results: every page's answer, the claims over instances, links that lead somewhere."""

import re

import pandas as pd
import pytest
from click.testing import CliRunner

from hysteresis_bench.commands.report import report
from hysteresis_bench.errors import UserError
from hysteresis_bench.report.index.page import INDEX, write_index
from hysteresis_bench.report.shared.blocks import Table
from hysteresis_bench.report.shared.page import Page, Section


def claims(over, **changed):
    row = {
        "problem": "static", "claim": "new <beats> old", "ablation": False, "verdict": "holds", "p": 0.0004, "a12": 0.9,
        "a12_low": 0.8, "a12_high": 0.95, "probability_equivalent": 0.0, "over": over,
    }  # fmt: skip
    return row | changed


TABLE = Table("t", ["h"], [["not an answer"]], "nor a note")


@pytest.fixture
def kept(tmp_path):
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        answer = [
            f"The answer of {name} is 42 & more.",
            "A second.",
            "A third.",
            Table("t", ["h"], [["not an answer"]]),
        ]
        sections = [Section("rest", "Rest", ["not in the answer"])]
        Page(f"Study {name}", "k", sections, answer).write(tmp_path / name / "report.html")
    rows = [
        claims("20 instances"),
        claims("20 instances", verdict="cannot tell", probability_equivalent=None),
        claims("20 instances", ablation=True),
        claims("30 trials", claim="of one instance"),
    ]
    (tmp_path / "four").mkdir()
    Page("Without an answer", "Eleven devices", [Section("rest", "Rest", ["A paragraph."])]).write(
        tmp_path / "four" / "report.html"
    )
    pd.DataFrame(rows).to_csv(tmp_path / "one" / "claims.csv", index=False)
    (tmp_path / "three").mkdir()
    (tmp_path / "three" / "laws.csv").write_text("a\n1\n")
    (tmp_path / "empty").mkdir()
    return tmp_path


def test_it_says_what_every_report_answers_and_judges_over_instances_only(kept):
    page = write_index(kept).read_text(encoding="utf-8")
    for words in ("Study one", "The answer of two is 42 &amp; more.", "A second.", "A third."):
        assert words in page
    assert "not an answer" not in page
    assert "nor a note" not in page
    assert "not in the answer" not in page
    assert "Of 2 judgements on the papers’ claims, each over 20 instances of the device: 1 holds and 1 cannot" in page
    assert "What holds: “new &lt;beats&gt; old” (on static)." in page
    assert page.count("new &lt;beats&gt; old") == 3
    assert "of one instance" not in page
    assert "Eleven devices" in page
    assert "A paragraph." not in page
    links = [link for link in re.findall(r'href="([^"#]+)"', page)]
    assert links == [
        "four/report.html",
        "one/report.html",
        "two/report.html",
        "three/laws.csv",
        *["one/report.html"] * 2,
    ]
    assert all((kept / link).is_file() for link in links)


def test_where_neither_arrives_it_says_so_and_names_what_does_not_hold(kept):
    why = "neither comes to the best known in most of them"
    rows = [claims("20 instances", verdict="cannot tell", why=why), claims("20 instances", verdict="does not hold")]
    pd.DataFrame(rows).to_csv(kept / "one" / "claims.csv", index=False)
    page = write_index(kept).read_text(encoding="utf-8")
    assert "1 cannot be told, because neither of the two comes to the best known" in page
    assert "neither arrives</td>" in page
    assert "What does not, as the contrary does: “new &lt;beats&gt; old” (on static)." in page


def test_the_command_writes_it_for_a_folder_of_results(kept):
    told = CliRunner().invoke(report, [str(kept)])
    assert told.exit_code == 0, told.output
    assert (kept / INDEX).is_file()
    first = (kept / INDEX).read_bytes()
    CliRunner().invoke(report, [str(kept)])
    assert (kept / INDEX).read_bytes() == first


def test_a_folder_without_reports_has_no_index(tmp_path):
    with pytest.raises(UserError, match="holds no results"):
        write_index(tmp_path)
