"""How long commands take from their first instruction to their last, with everything compiled, and a report.

python benchmarks/start_up.py
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from resources import measured
from table import Line, show

from hysteresis_bench.data.data_files import write_csv

ROOT = Path(__file__).parents[1]
ROUNDS = 3


def environment(folder: Path) -> dict[str, str]:
    """Byte code is kept, as it is where nobody forbids it; the model of the synthetic study is found."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {**kept, "PYTHONPYCACHEPREFIX": str(folder / "byte-code"), "PYTHONPATH": str(ROOT / "tests/test_plugins")}


def seconds(folder: Path, arguments: Sequence[str], rounds: int = ROUNDS) -> tuple[float, float]:
    """Wall time and CPU time of a whole process, medians, after one that compiles where there are several."""
    call = [sys.executable, "-m", "hysteresis_bench", *arguments]
    taken = []
    for _ in range(rounds + 1):
        before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        subprocess.run(call, cwd=folder, env=environment(folder), check=True, capture_output=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        taken.append((time.perf_counter() - begun, spent))
    wall, cpu = np.median(taken[1:] or taken, axis=0)
    return float(wall), float(cpu)


def main() -> None:
    sys.path[:0] = [str(ROOT)]
    from tests.synthetic_study import write_results

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_csv(folder / "data.csv", measured(2000))
        few, many = (write_results(folder / f"{trials}", trials) for trials in (10, 3125))
        asked = {
            ("--help",): 0.25,
            ("list",): 0.5,
            ("fit", "data.csv", "--model", "bouc-wen", "--force"): 2.0,
            ("report", str(few)): 5.0,
            ("report", str(many)): 60.0,
        }
        walls, cpus = [], []
        for arguments, most in asked.items():
            wall, cpu = seconds(folder, arguments, 0 if str(many) in arguments else ROUNDS)
            words = " ".join(arguments).replace(str(few), "of 160 trials").replace(str(many), "of 50 000 trials")
            walls.append(Line(words, wall))
            cpus.append(Line(words, cpu, most))
        show("A whole process, everything compiled", "s of CPU time", cpus)
        show("The same", "s of wall time, with whatever else the machine does", walls)
        megabytes = 1e-6 * (many / "report.html").stat().st_size
        show("The report of 50 000 trials", "MB", [Line("report.html", megabytes, 5.0)])


if __name__ == "__main__":
    main()
