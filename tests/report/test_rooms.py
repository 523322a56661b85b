"""Pages share what lies below them: a room of the report knows the rooms before it, and none after."""

import ast
from pathlib import Path

import hysteresis_bench.report

REPORT = Path(hysteresis_bench.report.__file__).parent

ROOMS = [
    "shared",
    "trials",
    "paper",
    "searches",
    "trial",
    "stages",
    "laws",
    "diagnosis",
    "study",
    "diagnosis_study",
    "fit",
    "control",
    "index",
]


def imported(path: Path) -> set[str]:
    """Rooms of the report that a file imports, wherever in it."""
    modules = [node.module or "" for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.ImportFrom)]
    return {module.split(".")[2] for module in modules if module.startswith("hysteresis_bench.report.")}


def test_every_room_is_listed():
    assert {path.parent.name for path in REPORT.glob("*/__init__.py")} == set(ROOMS)


def test_a_room_knows_the_rooms_before_it_only():
    later = [
        f"{path.relative_to(REPORT)} -> {room}"
        for place, name in enumerate(ROOMS)
        for path in (REPORT / name).rglob("*.py")
        for room in imported(path)
        if ROOMS.index(room) > place
    ]
    assert not later


def test_no_room_is_crowded():
    assert all(len(list((REPORT / name).glob("*.py"))) <= 12 for name in ROOMS)
