"""How every benchmark measures and prints: CPU time in interleaved rounds, and a table with each line held or missed.

Other load on the machine moves absolute times; trust the ratios inside one run.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table

Run = Callable[[], object]


@dataclass(frozen=True)
class Line:
    """A measured number, and what is asked of it: at most, or at least. None: nothing is asked."""

    name: str
    value: float
    most: float | None = None
    least: float | None = None

    @property
    def asked(self) -> str:
        return f"≤ {self.most:g}" if self.most is not None else f"≥ {self.least:g}" if self.least is not None else ""

    @property
    def verdict(self) -> str:
        if not self.asked:
            return ""
        above = self.least is not None and self.value < self.least
        return "[red]missed[/]" if above or (self.most is not None and self.value > self.most) else "[green]held[/]"


def show(title: str, unit: str, lines: Iterable[Line]) -> None:
    """Print a table."""
    table = Table(box=None, pad_edge=False, padding=(0, 3, 0, 0))
    for heading in ("", unit, "asked", ""):
        table.add_column(escape(heading), justify="right" if heading else "left")
    for line in lines:
        table.add_row(escape(line.name), f"{line.value:.3g}", line.asked, line.verdict)
    console = Console(width=120, highlight=False)
    console.print(f"[bold]{escape(title)}[/]")
    console.print(table)
    console.print()


def times(runs: Mapping[str, Run], rounds: int) -> dict[str, list[float]]:
    """CPU seconds of this thread, each run once a round; the first round, which compiles, does not count."""
    taken: dict[str, list[float]] = {name: [] for name in runs}
    for turn in range(rounds + 1):
        for name, run in runs.items():
            start = time.thread_time()
            run()
            if turn > 0:
                taken[name].append(time.thread_time() - start)
    return taken


def fastest(runs: Mapping[str, Run], rounds: int) -> dict[str, float]:
    """Of the rounds: what a run costs where nothing else disturbs the caches."""
    return {name: min(seconds) for name, seconds in times(runs, rounds).items()}


def medians(runs: Mapping[str, Run], rounds: int) -> dict[str, float]:
    """Over the rounds: what a run costs on this machine as it is."""
    return {name: float(np.median(seconds)) for name, seconds in times(runs, rounds).items()}
