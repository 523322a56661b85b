"""Give everything that is read, and every model and effect, inputs that nobody would write, and count what happens.

    .venv/bin/python benchmarks/fuzzing.py [--inputs N] [--seed S] [--only NAME]

An input is answered, or refused with a sentence. What fails is a traceback, a hang, or a silent wrong number: where the
same data are written in another way (other units, another order of the columns, a NaN put in, rows shuffled), the
numbers must be the same, or there must be a sentence. Exits with 1 where anything fails.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Iterable, Sequence
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).parents[1]))

from benchmarks.fuzz import folders, measurements, model_files, rewritten, simulations, study_files
from benchmarks.fuzz.target import KINDS, Count, Target, fuzz

READ = (measurements, rewritten, model_files, study_files, folders, simulations)
TARGETS: tuple[Target, ...] = tuple(target for module in READ for target in module.TARGETS)


def fuzz_all(targets: Sequence[Target], inputs: int, seed: int) -> dict[str, Count]:
    """By the target's name; every target gets its share of the inputs, and one at least."""
    shares = sum(target.share for target in targets)
    counts = {}
    for target in targets:
        begun = time.monotonic()
        counts[target.name] = fuzz(target, max(1, round(inputs * target.share / shares)), seed)
        print(f"{target.name:32}{told([counts[target.name]])}  {time.monotonic() - begun:7.1f} s", flush=True)
        for failure, given in counts[target.name].failures.items():
            print(f"    {failure}\n        {given}", flush=True)
    return counts


def told(counts: Iterable[Count]) -> str:
    """How many inputs came to what, altogether."""
    found = list(counts)
    return "  ".join(f"{sum(getattr(count, kind) for count in found):6d} {kind}" for kind in KINDS)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--inputs", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", metavar="NAME", help="targets with this in their name")
    asked = parser.parse_args()
    targets = [target for target in TARGETS if asked.only in target.name]
    counts = fuzz_all(targets, asked.inputs, asked.seed).values()
    print(f"{'all':32}{told(counts)}")
    sys.exit(1 if any(count.failed for count in counts) else 0)


if __name__ == "__main__":
    main()
