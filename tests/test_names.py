"""No file of the package names an effect, an optimizer or a model; the declared defaults stand in the registry."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import hysteresis_bench
from hysteresis_bench import registry

PACKAGE = Path(hysteresis_bench.__file__).parent
DEFAULTS = PACKAGE / "registry.py"
NAMES = {*registry.names("models"), *registry.names("effects"), *registry.names("optimizers"), *registry.offered()}
QUOTED = re.compile(f"""["'`]({"|".join(sorted(map(re.escape, NAMES)))})["'`]""")


def strings(path: Path) -> Iterator[tuple[int, str]]:
    """Line and text of every string of a file that is no docstring; what f-strings say literally is among them."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    documented = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in documented:
            yield node.lineno, node.value


def test_no_file_names_a_plugin():
    named = [
        f"{path.relative_to(PACKAGE)}:{line} {text!r}"
        for path in sorted(PACKAGE.rglob("*.py"))
        if path != DEFAULTS
        for line, text in strings(path)
        if text in NAMES or QUOTED.search(text)
    ]
    assert named == []


def test_every_default_is_registered():
    told = {text for _, text in strings(DEFAULTS)}
    assert told & NAMES == {
        registry.SEARCH,
        registry.REFERENCE,
        registry.RANDOM_SEARCH,
        registry.COMMON_OFFSET,
        registry.RECORD_OFFSET,
        registry.DESCRIPTION,
        registry.BOUC_WEN,
        registry.HAMMERSTEIN,
    }
