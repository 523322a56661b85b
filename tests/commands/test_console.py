"""Names are printed as they are: none is a picture, none is markup."""

import re
from pathlib import Path

import hysteresis_bench
from hysteresis_bench.commands.terminal.console import plain_console, say_notes, say_path

PACKAGE = Path(hysteresis_bench.__file__).parent


def test_names_of_records_and_files_stay_as_they_are(capsys):
    console = plain_console()
    console.print("p:b: the residual is larger.", highlight=False)
    say_notes(console, ["p:x: spikes [red] left out."])
    say_path(console, "page", Path("of:a:[red]run.html"))
    told = capsys.readouterr().out
    assert "p:b: the" in told
    assert "p:x: spikes [red] left" in told
    assert "of:a:[red]run.html" in told


def test_no_console_draws_pictures():
    made = [made for path in PACKAGE.rglob("*.py") for made in re.findall(r"\bConsole\(.*", path.read_text("utf-8"))]
    assert made
    assert all("emoji=False" in one for one in made)
