"""A fitted model in use: what the parts of `control` share."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from hysteresis_bench.commands.stopping import told_when_stopped
from hysteresis_bench.commands.terminal.steps import steps_told
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.progress import OnStep


@dataclass(frozen=True, eq=False)
class Use:
    """file : that `fitted` was read from;  folder : where files go
    plot : the figure, None for one in the folder;  as_json : told for a program"""

    fitted: FittedModel
    file: Path
    folder: Path
    plot: Path | None
    as_json: bool

    @contextmanager
    def told(self) -> Iterator[OnStep]:
        """Tells the steps of what runs inside, and where it is stopped that nothing was written."""
        kept, again = f"nothing was written to {self.folder}", "Run it again to begin anew."
        with told_when_stopped("control", lambda: kept, again), steps_told("control") as on_step:
            yield on_step
