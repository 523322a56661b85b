"""The house: rooms that are not crowded, files that hold one idea, functions that fit a screen."""

import ast
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import hysteresis_bench
import hysteresis_plugins

PACKAGE, PLUGINS = Path(hysteresis_bench.__file__).parent, Path(hysteresis_plugins.__file__).parent
FILES = sorted([*PACKAGE.rglob("*.py"), *PLUGINS.rglob("*.py")])
TOP, ROOM, LINES, FUNCTION, PARAMETERS, POSITIONAL = 13, 12, 300, 80, 7, 3


def functions(path: Path) -> Iterator[ast.FunctionDef]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef):
            yield node


def compiled(node: ast.FunctionDef) -> bool:
    return any("njit" in ast.unparse(decorator) for decorator in node.decorator_list)


def test_no_room_is_crowded():
    rooms = Counter(path.parent for path in PACKAGE.rglob("*.py") if path.parent != PACKAGE / "kernels")
    assert rooms[PACKAGE] <= TOP
    assert not {str(room): count for room, count in rooms.items() if room != PACKAGE and count > ROOM}


def test_a_file_holds_one_idea():
    long = {str(path): count for path in FILES if (count := len(path.read_text(encoding="utf-8").splitlines())) > LINES}
    assert not long


def test_functions_fit_a_screen():
    long = [
        f"{path.name}:{node.name} ({node.end_lineno - node.lineno + 1} lines)"
        for path in FILES
        for node in functions(path)
        if not compiled(node) and node.end_lineno and node.end_lineno - node.lineno + 1 > FUNCTION
    ]
    assert not long


def test_public_functions_take_few_arguments_and_name_most_of_them():
    """Commands are left out: click hands them the options of the command line, each by its name."""
    crowded = []
    for path in sorted(PACKAGE.rglob("*.py")):
        if {"commands", "kernels"} & {*path.relative_to(PACKAGE).parts}:
            continue
        for node in functions(path):
            names = [a.arg for a in (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs)]
            count = len([name for name in names if name not in ("self", "cls")])
            if not node.name.startswith("_") and count > PARAMETERS:
                crowded.append(f"{path.relative_to(PACKAGE)}:{node.name} ({count} parameters)")
    assert not crowded
