"""The files of a new plugin's distribution."""

from __future__ import annotations

import re
from importlib.metadata import version
from pathlib import Path
from string import Template

from hysteresis_bench import registry

HERE = Path(__file__).parent
NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
EXAMPLE = "Example"
"""The class of the examples in this folder, which takes the new plugin's name."""


def distribution_of(name: str) -> str:
    """Name of the distribution, unlike any library's that the plugin may be named after."""
    return f"hysteresis-bench-{name}"


def name_faults(kind: registry.Kind, name: str) -> list[str]:
    """What is wrong with a new plugin's name, a sentence each; empty when nothing is."""
    if not NAME.fullmatch(name):
        return [f'"{name}" is no name for a plugin: lower-case letters and digits, with hyphens between words.']
    if name in registry.names(kind):
        return [f'{registry.load(kind, name).distribution} already has the {kind[:-1]} "{name}"; choose another name.']
    return []


def files(kind: registry.Kind, name: str) -> dict[str, str]:
    """Text by file name: pyproject.toml, the module with an example, its test, a README."""
    word = kind[:-1]
    source = (HERE / f"{word}.py").read_text(encoding="utf-8")
    module = distribution_of(name).replace("-", "_")
    class_name = "".join(part.capitalize() for part in name.split("-"))
    if re.search(rf"\b{class_name}\b", source):  # such as a rig named "record"
        class_name += word.capitalize()
    values = {
        "name": name,
        "kind": kind,
        "word": word,
        "module": module,
        "class_name": class_name,
        "contract": f"{word.capitalize()}Contract",
        "distribution": distribution_of(name),
        "says": f"The {word} {name} for hysteresis-bench.",
        "version": version("hysteresis-bench"),
    }

    def filled(file: str) -> str:
        return Template((HERE / file).read_text(encoding="utf-8")).substitute(values)

    return {
        "pyproject.toml": filled("pyproject.txt"),
        "README.md": filled("readme.txt"),
        f"{module}.py": re.sub(rf"\b{EXAMPLE}\b", class_name, source),
        f"test_{module}.py": filled("test.txt"),
    }
