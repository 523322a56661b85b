"""The progress bar of a study: trials done, time left, best so far."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from hysteresis_bench.commands.terminal.steps import steps_told
from hysteresis_bench.progress import Step

if TYPE_CHECKING:
    from hysteresis_bench.study.run import Progress as StudyProgress


@contextmanager
def progress_bar(console: Console) -> Iterator[Callable[[StudyProgress], None]]:
    """Yields what a study calls after every trial."""
    if not console.is_terminal:
        with steps_told("run") as on_step:

            def on_trial(progress: StudyProgress) -> None:
                over = progress.total and progress.done == progress.total
                on_step(Step("what follows the trials") if over else Step("trials", progress.done, progress.total))

            yield on_trial
        return
    best: dict[str, tuple[float, str]] = {}
    failed = 0
    columns = (
        TextColumn("trials"),
        BarColumn(bar_width=24),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(compact=True),
        TextColumn("{task.description}"),
    )
    with Progress(*columns, console=console, speed_estimate_period=300) as bar:
        task = bar.add_task("", total=None)

        def on_progress(progress: StudyProgress) -> None:
            nonlocal failed
            outcome = progress.outcome
            if outcome is not None and outcome.fitness is None:
                failed += 1
            elif outcome is not None and outcome.relative_rms is not None:
                entry = (outcome.relative_rms, outcome.optimizer)
                best[outcome.problem] = min(entry, best.get(outcome.problem, entry))
            parts = [f"{problem}: {100 * rms:.2f} % {name}" for problem, (rms, name) in sorted(best.items())]
            parts += [f"[red]{failed} failed[/]"] if failed else []
            description = ("best " if best else "") + " · ".join(parts)
            if progress.done == progress.total:
                description += " · now what follows the trials"
            bar.update(task, completed=progress.done, total=progress.total, description=description)

        yield on_progress
