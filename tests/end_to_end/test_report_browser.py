"""A report in a real browser: it renders, fits a phone, and asks the network for nothing."""

import re
import shutil
import subprocess
from html import unescape

import pytest

from hysteresis_bench.report.shared.blocks import Details, Table
from hysteresis_bench.report.shared.page import Page, Section
from hysteresis_bench.report.study import write_report
from tests.synthetic_study import write_results

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
needs_browser = pytest.mark.skipif(BROWSER is None, reason="no chromium or chrome on this machine")


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return write_report(write_results(tmp_path_factory.mktemp("report"), trials=14))


def browse(page, profile, *options):
    command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}", *options]
    done = subprocess.run([*command, page.as_uri()], capture_output=True, text=True, timeout=90)
    assert done.returncode == 0, done.stderr
    return done.stdout


@needs_browser
def test_every_section_and_figure_renders(page, tmp_path):
    dom = browse(page, tmp_path, "--dump-dom")
    for section in ("answer", "run", "published", "claims", "optimizers", "searches", "signals", "audit", "decisions"):
        assert f'id="{section}"' in dom
    assert dom.count("<svg") == dom.count("<figure>") > 10
    assert not re.search(r"(src|href|srcset)=\"(https?:)?//", dom)


@needs_browser
@pytest.mark.parametrize("width", [380, 768, 1280])
def test_the_page_never_scrolls_sideways(page, tmp_path, width):
    # a frame has the width that it is given, where a headless window has a least one
    frame = tmp_path / "frame.html"
    frame.write_text(
        f'<iframe id="f" src="{page.as_uri()}" style="width:{width}px;height:900px;border:0"></iframe>'
        "<script>onload=()=>{const d=document.getElementById('f').contentDocument.documentElement;"
        "document.body.dataset.wide=d.scrollWidth;document.body.dataset.client=d.clientWidth}</script>",
        encoding="utf-8",
    )
    dom = browse(frame, tmp_path / "profile", "--dump-dom", "--allow-file-access-from-files")
    wide, client = (int(re.search(rf'data-{name}="(\d+)"', dom)[1]) for name in ("wide", "client"))
    assert 0 < client <= width
    assert wide <= client


def asked(page, tmp_path, script):
    """What a script in a frame of 1280 pixels answers; `w` is the page's window, `d` its document."""
    frame = tmp_path / "asking.html"
    frame.write_text(
        f'<iframe id="f" src="{page.as_uri()}" style="width:1280px;height:900px;border:0"></iframe><script>onload=()=>'
        "{const w=document.getElementById('f').contentWindow,d=w.document;"
        f"document.body.dataset.answer=({script})}}</script>",
        encoding="utf-8",
    )
    dom = browse(frame, tmp_path / "profile", "--dump-dom", "--allow-file-access-from-files")
    return re.search(r'data-answer="([^"]*)"', dom)[1]


@needs_browser
def test_what_is_folded_away_is_open_while_the_page_is_printed(tmp_path):
    shown = Page("p", "k", [Section("s", "S", [Details("Show the text", ["A line."])])]).write(tmp_path / "page.html")
    opened = "['beforeprint','afterprint'].map(e=>(w.dispatchEvent(new w.Event(e)),d.querySelector('details').open))"
    assert asked(shown, tmp_path, opened) == "true,false"


@needs_browser
def test_a_table_of_forty_columns_fits_the_page(tmp_path):
    names = [f"an-effect-with-a-name-{i}" for i in range(40)]
    table = Table("t", ["Hidden", *names], [["resonance", *["12"] * len(names)]])
    shown = Page("p", "k", [Section("s", "S", [table])]).write(tmp_path / "page.html")
    overflow = "(e=>e.scrollWidth-e.clientWidth)(d.querySelector('.scroll'))"
    assert int(asked(shown, tmp_path, overflow)) <= 0


@needs_browser
def test_a_click_on_a_head_sorts_the_table_and_a_second_one_turns_it_round(tmp_path):
    numbers = ["15\u202f050", "not reached", "2.5×10⁻³ (1 to 3)", "0.4\u202f%", "< 0.001", "1.1×10⁶"]
    shown = Page("p", "k", [Section("s", "S", [Table("t", ["Name", "Number"], [["x", each] for each in numbers])])])
    page = shown.write(tmp_path / "page.html")
    for clicks, order in ((0, [0, 1, 2, 3, 4, 5]), (1, [4, 2, 3, 0, 5, 1]), (2, [1, 5, 0, 3, 2, 4])):
        click = "document.querySelectorAll('thead button')[1].click();" * clicks
        clicked = tmp_path / "clicked.html"
        text = page.read_text(encoding="utf-8").replace("</body>", f"<script>{click}</script></body>")
        clicked.write_text(text, encoding="utf-8")
        dom = browse(clicked, tmp_path / "profile", "--dump-dom")
        cells = re.findall(r'<td class="number">([^<]*(?:&lt;)?[^<]*)</td>', dom)
        assert [unescape(cell) for cell in cells] == [numbers[place] for place in order]


@needs_browser
def test_a_picture_of_it_is_not_blank(page, tmp_path):
    picture = tmp_path / "page.png"
    browse(page, tmp_path, f"--screenshot={picture}", "--window-size=1200,2000")
    assert picture.stat().st_size > 50_000
