"""The reports that are kept: every link to a file beside them leads somewhere."""

import re
from pathlib import Path

import pytest

RESULTS = Path(__file__).parents[2] / "results"
LINK = re.compile(r'<a [^>]*href="([^"#:]+)"')


@pytest.mark.parametrize("page", sorted(RESULTS.rglob("*.html")), ids=lambda page: str(page.relative_to(RESULTS)))
def test_every_link_works(page):
    dead = [link for link in LINK.findall(page.read_text(encoding="utf-8")) if not (page.parent / link).exists()]
    assert not dead
