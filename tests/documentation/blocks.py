"""Code blocks of Markdown pages, and a folder in which their commands and scripts can run."""

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from hysteresis_bench import measure
from hysteresis_bench.data.data_files import write_csv
from tests.conftest import ROOT

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs" / "pages").glob("*.md"))]

STUDY = """
title = "A stand-in for a study that takes minutes"
seed = 1
trials = 3
budget = 300
problem = [{ name = "loop", rig = "hidden-effects", fitted = ["nested"], model = "bouc-wen" }]
optimizer = [{ plugin = "pso" }, { plugin = "mpso" }]
"""


@dataclass(frozen=True)
class Block:
    """A fenced block: where it stands, its language, its text."""

    page: str
    line: int
    language: str
    text: str

    def __str__(self) -> str:
        return f"{self.page}:{self.line}"


def blocks(*languages: str) -> list[Block]:
    """The blocks of all pages in these languages; in any where none is named."""
    found = []
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for match in FENCE.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            found.append(Block(page.name, line, match[1], match[2]))
    return [block for block in found if not languages or block.language in languages]


def commands(block: Block) -> list[str]:
    """The lines after a prompt, without their comments."""
    lines = re.sub(r"\\\n", " ", block.text).splitlines()
    return [line.removeprefix("$ ").split(" #")[0].strip() for line in lines if line.startswith("$ ")]


def fill(folder: Path) -> None:
    """The files that the pages speak of, small."""
    for names, model in ((("slow", "fast", "nested", "mixed"), "bouc-wen"), (("mine", "other"), "jiles-atherton")):
        for name, experiment in zip(names, ("slow", "fast", "nested", "mixed"), strict=False):
            write_csv(folder / f"{name}.csv", measure("hidden-effects", experiment, settings={"model": model}))
    experiments = ("slow", "fast", "mixed")
    logged = measure("hidden-effects", *experiments, settings={"model": "bouc-wen", "effects": ["creep"]})
    lines = [
        ";".join([*(f"{value:.6f}".replace(".", ",") for value in row), record.name])
        for record in logged.records
        for row in zip(record.time, record.input, record.output, strict=True)
    ]
    (folder / "scope.csv").write_text("\n".join(["Zeit (s);Spannung (V);Weg (um);run", *lines]), encoding="utf-8")
    phase = 2 * np.pi * np.arange(200) / 200
    loops = [
        pd.DataFrame(
            {
                "time [s]": phase,
                "input [A/m]": height * np.sin(phase),
                "output [T]": np.tanh(height / 60.0 * np.sin(phase - 0.2)),
                "run": run,
            }
        )
        for run, height in ((1, 40.0), (2, 80.0), (3, 60.0))
    ]
    pd.concat(loops).to_csv(folder / "loops.csv", index=False)
    (folder / "studies").mkdir()
    for study in ("sma", "mine"):
        (folder / "studies" / f"{study}.toml").write_text(STUDY, encoding="utf-8")


def entry_points(block: Block) -> dict[str, str]:
    """name -> object of every entry point that a TOML block declares."""
    groups = tomllib.loads(block.text).get("project", {}).get("entry-points", {})
    return {name: target for group in groups.values() for name, target in group.items()}
