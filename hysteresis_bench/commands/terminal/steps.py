"""Where a command is: a bar on a terminal, a line every few seconds in a pipe or a file, both on standard error."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from hysteresis_bench.commands.terminal.console import terminal
from hysteresis_bench.progress import OnStep, Step

FIRST, EVERY = 1.0, 5.0
"""Seconds to the first line, and between lines."""


@dataclass
class Reached:
    """The step that a computation is in, and when it began."""

    step: Step
    since: float
    begun: float

    def on_step(self, step: Step) -> None:
        if step.what != self.step.what:
            self.since = time.monotonic()
        self.step = step

    def words(self) -> str:
        """`fit: search 1 of 2, 40 % of 15050, 12 s since the beginning, about 18 s left of this step`."""
        step, now = self.step, time.monotonic()
        said = [step.what]
        if step.total:
            said.append(f"{100 * step.done / step.total:.0f} % of {step.total}")
        said.append(f"{clock(now - self.begun)} since the beginning")
        if step.total and step.done:
            left = (now - self.since) * (step.total - step.done) / step.done
            said.append(f"about {clock(left)} left of this step")
        return ", ".join(said)


def clock(seconds: float) -> str:
    """`12 s`, `3 min 20 s`, `2 h 5 min`."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    return f"{whole // 60} min {whole % 60} s" if whole < 3600 else f"{whole // 3600} h {whole % 3600 // 60} min"


@contextmanager
def steps_told(name: str, console: Console | None = None) -> Iterator[OnStep]:
    """Yields what a computation calls with its steps; name : of the command."""
    console = console or terminal(aside=True, soft_wrap=True)
    now = time.monotonic()
    reached = Reached(Step("beginning"), now, now)
    if console.is_terminal:
        with _bar(name, console, reached) as on_step:
            yield on_step
        return
    ended = threading.Event()

    def tell() -> None:
        wait = FIRST
        while not ended.wait(wait):
            console.print(f"{name}: {reached.words()}", highlight=False, markup=False)
            wait = EVERY

    teller = threading.Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield reached.on_step
    finally:
        ended.set()
        teller.join()


@contextmanager
def _bar(name: str, console: Console, reached: Reached) -> Iterator[OnStep]:
    columns = (
        TextColumn(name),
        BarColumn(bar_width=20),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(compact=True),
        TextColumn("{task.description}"),
    )
    with Progress(*columns, console=console, transient=True, speed_estimate_period=60) as bar:
        task = bar.add_task("beginning", total=None)

        def on_step(step: Step) -> None:
            if step.what != reached.step.what:
                bar.reset(task, total=step.total, description=step.what)
            reached.on_step(step)
            bar.update(task, completed=step.done, total=step.total, description=step.what)

        yield on_step
