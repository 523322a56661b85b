"""Every measured device as a user asks about it: `diagnose` without a law, the error before and after.

    python benchmarks/diagnosed.py [NAME ...] [--out results/real-measurements] [--timeout SECONDS]

Looks for the data in the folder that HYSTERESIS_DATA names, or in ../shared/data beside the checkout. Devices and
splits are those of devices.py; no effect is given, and no law. It keeps what is derived: a row a device, which
real_measurements.py puts on its page. Devices that are there already are kept; name one to diagnose it again.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pandas as pd
from devices import DEVICES, Device, records_of
from limited import limited
from real_measurements import DATA, FOUND, ROOT

from hysteresis_bench import diagnose
from hysteresis_bench.errors import UserError

LATE = 600
"""Seconds after which a diagnosis is given up; the page names those that were given more."""


def diagnosed(device: Device) -> dict[str, object]:
    """One row, in the unit of the output."""
    begun = time.monotonic()
    found = diagnose(records_of(device), options=replace(device.options, jobs=1))
    before, after = found.before.held_out, found.after.held_out
    assert before is not None
    assert after is not None
    return {
        "device": device.name,
        "unit": device.units[2],
        "law": found.model_name,
        "effects": " ".join(found.effects),
        "stand_ins": " ".join(found.stand_ins),
        "verdict": found.verdict,
        "before": before.rmse,
        "after": after.rmse,
        "constant": found.after.constant,
        "floor": found.floor,
        "headline": found.headline,
        "seconds": round(time.monotonic() - begun),
    }


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "real-measurements")
    parser.add_argument("--timeout", type=int, default=LATE)
    given = parser.parse_args(arguments)
    given.out.mkdir(parents=True, exist_ok=True)
    path = given.out / FOUND
    rows = pd.read_csv(path, keep_default_na=False) if path.is_file() else pd.DataFrame(columns=["device"])
    for device in DEVICES:
        asked = (
            any(name in device.name for name in given.names) if given.names else device.name not in {*rows["device"]}
        )
        if not asked or not all((DATA / file).is_file() for file in device.files):
            continue
        try:
            with limited(given.timeout):
                new = diagnosed(device)
        except (UserError, TimeoutError) as error:
            print(f"{device.name}: {str(error) or f'not ended after {given.timeout} s'}", flush=True)
            continue
        print(f"{device.name}: {new['law']}. {new['headline']} ({new['seconds']} s)", flush=True)
        rows = pd.concat([rows[rows["device"] != device.name], pd.DataFrame([new])], ignore_index=True)
        rows.to_csv(path, index=False, float_format="%.5g", lineterminator="\n")


if __name__ == "__main__":
    main()
