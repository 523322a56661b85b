"""Every law on measurements of every device: the error on what no law was fitted to, beside a polynomial and the noise.

    python benchmarks/laws.py [NAME ...] [--out results/measured-laws]

Looks for the data in the folder that HYSTERESIS_DATA names, or in ../shared/data beside the checkout. The splits are
those of devices.py, fixed before any law was fitted: the last third of a lone record, or the runs named. Of effects
that may act, those stay with which the chosen law predicts better what was left out of its fit. It keeps what is
derived: a row a device and law. Devices that are there already are kept; name one to compare it again.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pandas as pd
from devices import DEVICES, Device, records_of
from real_measurements import DATA, ROOT

from hysteresis_bench import compare
from hysteresis_bench.diagnosis.laws.comparison import BASELINE, Comparison
from hysteresis_bench.errors import UserError

NUMBERS = "laws.csv"
SUMMARY = ROOT / "results" / "real-measurements" / "laws.csv"


def compared(device: Device) -> pd.DataFrame:
    begun = time.time()
    dataset = records_of(device)
    sets = [device.effects] + ([(*device.effects, *device.perhaps)] if device.perhaps else [])
    tried = [compare(dataset, device.laws, names, options=replace(device.options, jobs=1)) for names in sets]
    found = min(tried, key=_unseen)
    effects = " ".join(sets[tried.index(found)])
    span = max(float(r.measured.max() - r.measured.min()) for r in dataset.held_out)
    told = {"device": device.name, "unit": device.units[2], "effects": effects}
    told |= {"chosen": found.chosen, "floor": found.floor, "span": span}
    print(
        f"{device.name}{f' with {effects}' if effects else ''}: {found.words} ({time.time() - begun:.0f} s)", flush=True
    )
    return found.table.drop(columns="seconds").assign(**told)


def _unseen(found: Comparison) -> float:
    """RMSE of the chosen law, or of the polynomial, on what was left out of its fit."""
    return float(found.table.set_index("law").loc[found.chosen or BASELINE, "unseen"])


def summary(rows: pd.DataFrame) -> str:
    """A line a device: the chosen law's error on what was held out, as a share of the polynomial's."""
    lines = [f"{'device':52s} {'law':28s} {'held out':>10s} {'polynomial':>10s} {'ratio':>6s} {'% of range':>10s}"]
    for name, part in rows.groupby("device", sort=False):
        by_law = part.set_index("law")
        chosen, plain = part["chosen"].iloc[0] or BASELINE, float(by_law.loc[BASELINE, "held_out"])
        error = float(by_law.loc[chosen, "held_out"])
        share = 100.0 * error / float(part["span"].iloc[0])
        lines.append(f"{name:52s} {chosen:28s} {error:10.4g} {plain:10.4g} {error / plain:6.3f} {share:10.3g}")
    return "\n".join(lines)


def kept(rows: pd.DataFrame) -> pd.DataFrame:
    """A row a device, also of those that were not run: the chosen law, what it and the polynomial leave, the floor.

    The floor is heard in the data before any law, and too high where samples are few for the loop, as those of a steel
    coupon are: the page shows the diagnosis's in its place, which is heard beside a law.
    """
    found = []
    for device in DEVICES:
        part = rows[rows["device"] == device.name].set_index("law") if len(rows) else rows
        row = {"device": device.name, "unit": device.units[2], "run": "yes" if len(part) else "not run"}
        row |= {"compared": len(device.laws) or "all", "repeats": device.repeats}
        if len(part):
            row["effects"] = part["effects"].iloc[0]
            law = part["chosen"].iloc[0] or BASELINE
            error, plain = float(part.loc[law, "held_out"]), float(part.loc[BASELINE, "held_out"])
            span = float(part["span"].iloc[0])
            asked = device.asked * (span if device.share else 1.0) if device.asked else None
            row |= {"law": law, "held_out": error, "polynomial": plain, "ratio": error / plain, "asked": asked}
            row |= {"floor": part["floor"].iloc[0], "range": span}
        found.append(row)
    return pd.DataFrame(found)


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "measured-laws")
    given = parser.parse_args(arguments)
    path = given.out / NUMBERS
    rows = (
        pd.read_csv(path, keep_default_na=True).fillna({"chosen": "", "effects": ""})
        if path.is_file()
        else pd.DataFrame()
    )
    known = set(rows["device"]) if len(rows) else set()
    for device in DEVICES:
        asked = any(name in device.name for name in given.names)
        if not all((DATA / file).is_file() for file in device.files) or not (asked or device.name not in known):
            continue
        if given.names and not asked:
            continue
        try:
            new = compared(device)
        except UserError as error:
            print(f"{device.name}: {error}", flush=True)
            continue
        rows = pd.concat([rows[rows["device"] != device.name] if len(rows) else rows, new], ignore_index=True)
        given.out.mkdir(parents=True, exist_ok=True)
        rows.to_csv(path, index=False, float_format="%.5g", lineterminator="\n")
    if len(rows):
        kept(rows).to_csv(SUMMARY, index=False, float_format="%.5g", lineterminator="\n")
        print(summary(rows))


if __name__ == "__main__":
    main()
