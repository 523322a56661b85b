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


def is_room(folder: Path) -> bool:
    """Has it modules and no rooms within?"""
    return not any((one / "__init__.py").exists() for one in folder.iterdir() if one.is_dir())


def place_of(path: Path) -> str:
    """The room that a module stands in; the module itself where there are rooms beside it."""
    place = path.parent if is_room(path.parent) else path.with_suffix("")
    return ".".join(place.relative_to(PACKAGE).parts)


def neighbours(path: Path) -> set[str]:
    """Places that a module imports from, for its types too."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("hysteresis_bench"):
            base = PACKAGE.joinpath(*(node.module or "").split(".")[1:])
            names = [alias.name for alias in node.names] + ([] if base == PACKAGE else ["__init__"])
            files = (base.with_suffix(".py"), *(base / f"{name}.py" for name in names))
            found |= {place_of(file) for file in files if file.exists()}
    return found - {place_of(path)}


def ring(graph: dict[str, set[str]]) -> list[str]:
    """Places each of which imports the next one, and the last one the first; empty where there are none."""
    left = graph
    while ended := {place for place, others in left.items() if not others & {*left}}:
        left = {place: others for place, others in left.items() if place not in ended}
    way = sorted(left)[:1]
    while way and len({*way}) == len(way):
        way.append(min(left[way[-1]] & {*left}))
    return way[way.index(way[-1]) + 1 :] if way else []


def test_no_rooms_import_each_other():
    """Directly or by way of others. The front door, which opens rooms when they are asked for, is left out."""
    graph: dict[str, set[str]] = {}
    for path in {*PACKAGE.rglob("*.py")} - {PACKAGE / "__init__.py"}:
        graph.setdefault(place_of(path), set()).update(neighbours(path))
    assert ring(graph) == []


def test_rooms_that_import_each_other_by_way_of_others_are_found():
    graph = {"laws": {"doubt", "fit"}, "doubt": {"search"}, "search": {"laws"}, "fit": set(), "page": {"laws"}}
    assert sorted(ring(graph)) == ["doubt", "laws", "search"]
    assert ring({**graph, "search": {"fit"}}) == []


def test_plugins_know_the_contracts_and_nothing_above():
    allowed = {"arrays", "contracts", "free_forms", "parameters", "signals", "kernels"}
    folder = Path(__import__("hysteresis_plugins").__file__).parent
    strangers = {
        f"{path.name} -> {name}" for path in folder.rglob("*.py") for name in imported(path) if name not in allowed
    }
    assert not strangers
