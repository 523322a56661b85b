"""What the intervals beside predictions hold of excitations that no fit saw, on data of the rig `hidden-effects`.

    python benchmarks/intervals.py [DRAWS]

Prints a row a kind of data: how many records, and the mean and the lowest share of samples within the 90 % interval.
"""

from __future__ import annotations

import sys

import numpy as np
import pandas as pd

from hysteresis_bench import FitOptions, fit, measure
from hysteresis_bench.registry import load

GIVEN = (("slow", "fast", "nested"), ("nested", "sweep"), ("slow",))
RIGHT = [(law, law, ()) for law in ("bouc-wen", "dahl", "prandtl-ishlinskii", "jiles-atherton")]
WRONG = [
    ("bouc-wen", "dahl", ()),
    ("jiles-atherton", "bouc-wen", ()),
    ("prandtl-ishlinskii", "bouc-wen", ()),
    ("dahl", "bouc-wen", ()),
    ("bouc-wen", "jiles-atherton", ()),
]
LACKING = [("bouc-wen", "bouc-wen", (effect,)) for effect in ("creep", "input-lag")]
"""Makers, fitted laws, effects that are hidden and not fitted."""
KINDS = {"right law": RIGHT, "wrong law": WRONG, "an effect missing": LACKING}


def shares(maker: str, law: str, hidden: tuple[str, ...], given: tuple[str, ...], noise: str, draw: int) -> list[float]:
    """Of the samples of every other record within its 90 % interval."""
    settings = {"model": maker, "effects": list(hidden), "imperfect": noise, "draw": draw}
    others = [name for name in load("rigs", "hidden-effects").loaded.experiments if name not in given]
    seen, unseen = (measure("hidden-effects", *names, seed=draw, settings=settings) for names in (given, others))
    model = fit(seen, law, ["bias"], options=FitOptions(seed=draw, budget=3000)).model
    predicted = model.predict(unseen).records
    return [
        float(np.mean((made.columns["output_low"] <= old.measured) & (old.measured <= made.columns["output_high"])))
        for old, made in zip(unseen.records, predicted, strict=True)
    ]


def main(draws: int = 3) -> None:
    rows = [
        {"fitted": len(given), "data": kind, "noise": noise or "white", "within": share}
        for given in GIVEN
        for kind, cases in KINDS.items()
        for noise in ("", "coloured")
        for case in cases
        for draw in range(1, draws + 1)
        for share in shares(*case, given, noise, draw)
    ]
    table = pd.DataFrame(rows).groupby(["fitted", "data", "noise"])["within"]
    print(table.agg(["count", "mean", "median", "min"]).round(3).to_string())


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
