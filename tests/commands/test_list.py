"""`list`: a plugin in one sentence, by itself."""

import json
import re

import pytest
from click.testing import CliRunner

from hysteresis_bench.cli import main


@pytest.mark.parametrize("options", [[], ["--json"]])
def test_a_summary_stands_without_the_numbers_of_references_that_are_not_listed(options):
    output = CliRunner().invoke(main, ["list", *options], env={"COLUMNS": "300"}).output
    assert not re.search(r"[a-z] \[[0-9]+\]", json.dumps(json.loads(output)) if options else output)
