"""Imports go downward only: a floor knows nothing of the floors above it."""

import ast
from pathlib import Path

import hysteresis_bench

PACKAGE = Path(hysteresis_bench.__file__).parent

FLOORS = [
    ["cli", "__main__", "__init__"],
    ["commands"],
    ["testing"],
    ["schemas"],
    ["report"],
    ["study_diagnosis"],
    ["diagnosis_study"],
    ["diagnosis"],
    ["study"],
    ["control", "inspection", "export"],
    ["fit"],
    ["statistics"],
    ["compose"],
    ["registry"],
    ["declarations"],
    ["contracts", "free_forms", "data"],
    ["signals", "parameters"],
    ["errors", "kernels"],
    ["arrays", "progress"],
]
"""From the roof down. Names on one floor may know each other."""

FLOOR = {name: level for level, names in enumerate(FLOORS) for name in names}


def imported(path: Path) -> set[str]:
    """Names of our own modules that a file imports, wherever in it."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module == "hysteresis_bench":
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("hysteresis_bench."):
            found.add(node.module.split(".")[1])
    return found


def test_every_module_stands_on_a_floor():
    names = {path.stem for path in PACKAGE.glob("*.py")} | {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert names == set(FLOOR)


def test_imports_go_downward_only():
    upward = []
    for path in PACKAGE.rglob("*.py"):
        own = path.relative_to(PACKAGE).parts[0].removesuffix(".py")
        if own in ("cli", "__main__", "__init__"):
            continue
        upward += [f"{path.name} -> {name}" for name in imported(path) if FLOOR.get(name, 99) < FLOOR[own]]
    assert not upward


def test_plugins_know_the_contracts_and_nothing_above():
    allowed = {"arrays", "contracts", "free_forms", "parameters", "signals", "kernels"}
    folder = Path(__import__("hysteresis_plugins").__file__).parent
    strangers = {
        f"{path.name} -> {name}" for path in folder.rglob("*.py") for name in imported(path) if name not in allowed
    }
    assert not strangers
