"""The reports that are kept: every link to a file beside them leads to a file that is kept too."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
RESULTS = ROOT / "results"
LINK = re.compile(r'<a [^>]*href="([^"#:]+)"')


@pytest.fixture(scope="module")
def kept():
    """The files under results; in a checkout only those that are committed, as a fresh clone has no others."""
    if shutil.which("git") and (ROOT / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-z", "results"], cwd=ROOT, check=True, capture_output=True)
        return {(ROOT / name).resolve() for name in listed.stdout.decode().split("\0") if name}
    return {path.resolve() for path in RESULTS.rglob("*") if path.is_file()}


@pytest.mark.parametrize("page", sorted(RESULTS.rglob("*.html")), ids=lambda page: str(page.relative_to(RESULTS)))
def test_every_link_works(page, kept):
    dead = [
        link for link in LINK.findall(page.read_text(encoding="utf-8")) if (page.parent / link).resolve() not in kept
    ]
    assert not dead
