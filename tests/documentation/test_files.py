"""The page about files names every key that is written."""

import ast
import inspect
import textwrap

import pytest

from hysteresis_bench.diagnosis.findings.diagnosis_file import as_dict
from hysteresis_bench.fit.unseen.interval import Interval
from hysteresis_bench.schemas.forms import ModelFile
from tests.conftest import ROOT

PAGE = (ROOT / "docs/pages/files.md").read_text(encoding="utf-8")


def keys(function) -> list[str]:
    """Of the dictionary that a function returns, as they stand in its source."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    (returned,) = (node.value for node in ast.walk(tree) if isinstance(node, ast.Return))
    return [key.value for key in returned.keys if key is not None]


@pytest.mark.parametrize("function", [as_dict, Interval.as_dict])
def test_every_key_that_is_returned_is_told(function):
    found = keys(function)
    assert len(found) > 2
    assert not [key for key in found if f"`{key}`" not in PAGE]


def test_every_key_of_a_model_is_told():
    names = {"schema" if name == "schema_number" else name for name in ModelFile.model_fields}
    assert not [name for name in names if f"`{name}`" not in PAGE]
