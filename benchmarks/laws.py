"""Every law on measurements of every device: the error on what no law was fitted to, beside a polynomial and the noise.

    python benchmarks/laws.py [NAME ...] [--out results/measured-laws]

Looks for the data in the folder that HYSTERESIS_DATA names, or in ../shared/data beside the checkout. The splits are
those below, fixed before any law was fitted: the last third of a lone record, or the runs named. What it keeps is
derived: a row a device and law. Devices that are there already are kept; name one to compare it again.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
from real_measurements import DATA, ROOT

from hysteresis_bench import compare, load
from hysteresis_bench.diagnosis.laws.comparison import BASELINE
from hysteresis_bench.diagnosis.preparation import with_held_out
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.errors import UserError
from hysteresis_bench.signals import Dataset, Record

NUMBERS = "laws.csv"
SUMMARY = ROOT / "results" / "real-measurements" / "laws.csv"
FEW = 40
"""Scored samples below which a run is left out, such as the first of reversal curves."""


WAY = 10
"""Samples of a way that was not recorded."""
PLAIN, SETTLED = DiagnosisOptions(), DiagnosisOptions(settle=True)


MAGNETIC = ("preisach-hats", "preisach", "energy-based", "jiles-atherton-clamped", "jiles-atherton-pinning")
SWITCHING = ("preisach-hats", "preisach", "ferroelectric", "prandtl-ishlinskii", "prandtl-ishlinskii-modified")
FRICTION = ("maxwell-slip", "dahl", "lugre", "bouc-wen", "bouc-wen-generalized", "preisach-hats", "preisach")
GENERAL = (*SWITCHING, "energy-based", "bouc-wen", "bouc-wen-generalized", "dahl", "maxwell-slip")
"""Laws that are compared on a kind of device: those of its own field, and the general ones."""


@dataclass(frozen=True)
class Device:
    """units : of time (sample: only an index), input and output;  held_out : names of runs, the last third where empty
    third : every third run is held out;  stride : every so manieth sample is kept
    laws : that are compared, all where empty;  effects : that the source of the data says act
    prepared : what the data's source asks for before a model sees them
    """

    name: str
    files: tuple[str, ...]
    units: tuple[str, str, str]
    held_out: tuple[str, ...] = ()
    third: bool = False
    stride: int = 1
    options: DiagnosisOptions = PLAIN
    laws: tuple[str, ...] = ()
    effects: tuple[str, ...] = ()
    prepared: Callable[[list[Record]], list[Record]] = list


def _from_saturation(field: float) -> Callable[[list[Record]], list[Record]]:
    """Reversal curves whose way down from saturation was not recorded: it is put before them, unscored."""

    def prepared(records: list[Record]) -> list[Record]:
        found = []
        for record in records:
            way = np.linspace(field, record.input[0], WAY + 1)[:-1]
            time = np.arange(WAY + record.time.size, dtype=float)
            output = np.concatenate([np.full(WAY, record.measured[0]), record.measured])
            u = np.concatenate([way, record.input])
            found.append(replace(record, time=time, input=u, output=output, columns={}, history=WAY))
        return found

    return prepared


def _between_maxima(records: list[Record]) -> list[Record]:
    """One long record of reversal curves, cut where the input is at its largest."""
    record = records[0]
    u = record.input
    top = 1 + np.flatnonzero((u[1:-1] >= u[:-2]) & (u[1:-1] > u[2:]) & (u[1:-1] > 0.97 * u.max()))
    cuts = pairwise(top)
    return [record.take(slice(a, b), f"{record.name}:{k}") for k, (a, b) in enumerate(cuts)]


def _runs(runs: Sequence[int]) -> Callable[[list[Record]], list[Record]]:
    return lambda records: [record for record in records if int(record.name.rpartition(":")[2]) in runs]


def _smoothed(runs: Sequence[int], width: int) -> Callable[[list[Record]], list[Record]]:
    """Some runs, the input's running mean in place of a noisy input."""

    def prepared(records: list[Record]) -> list[Record]:
        kept = _runs(runs)(records)
        padded = [np.pad(record.input, width // 2, mode="edge") for record in kept]
        means = [np.convolve(u, np.full(width, 1.0 / width), mode="valid") for u in padded]
        return [replace(record, input=u) for record, u in zip(kept, means, strict=True)]

    return prepared


def _first(samples: int) -> Callable[[list[Record]], list[Record]]:
    """What comes before the specimen fails, as the data's source says."""
    return lambda records: [record.take(slice(0, samples)) for record in records]


def _in(folder: str, *names: str) -> tuple[str, ...]:
    return tuple(f"{folder}/{name}.csv" for name in names)


BRFD = "sine_0p25Hz_band30lb_amp"
FILM = ("s", "V", "C/m^2")
ABOVE = (2, 3, 4, 5, 6)
"""Loops from 400 Hz up, where the ferroelectric tester has one delay."""
DEVICES = (
    Device(
        "piezo stack, full amplitude from a modulated record",
        _in("piezo-picma-ntu", "full_amplitude_1Hz", "modulated_1Hz_ramp_down"),
        ("s", "V", "um"),
        ("full_amplitude_1Hz",),
        stride=2,
        options=DiagnosisOptions(skip=0.5),
        laws=GENERAL,
        effects=("transport-delay",),
    ),
    *(
        Device(
            f"{name}, 700 Hz",
            _in(folder, file),
            FILM,
            (f"{file}:4",),
            options=SETTLED,
            laws=SWITCHING,
            effects=("threshold-rate", "transport-delay"),
            prepared=_runs(ABOVE),
        )
        for name, folder, file in (
            ("PZT film", "ferroelectric-pzt-film-a", "frequency_loops_8V"),
            ("FeFET stack", "ferroelectric-fefet-stack", "frequency_loops_5V"),
            ("HfO2 film", "ferroelectric-hfo2-film", "frequency_loops_4V"),
        )
    ),
    Device(
        "PZT reversal curves",
        _in("ferroelectric-pzt-film-a", "forc_7V_table2"),
        FILM,
        third=True,
        stride=2,
        laws=SWITCHING,
        prepared=_between_maxima,
    ),
    Device(
        "FeCo reversal curves",
        _in("forc-feco-nanowires", "forc"),
        ("sample", "A/m", "A m^2"),
        third=True,
        laws=MAGNETIC,
        prepared=_from_saturation(1.194e6),
    ),
    Device(
        "rock reversal curves",
        _in("forc-rock-agm", "forc"),
        ("sample", "A/m", "A m^2"),
        third=True,
        laws=MAGNETIC,
        prepared=_from_saturation(2.39e5),
    ),
    Device(
        "electrical steel, one loop",
        _in("magcore-go-steel-m130", "loops"),
        ("sample", "A/m", "T"),
        ("loops:0",),
        options=SETTLED,
        laws=MAGNETIC,
    ),
    Device(
        "Mn-Zn ferrite, one loop",
        _in("magcore-mnzn-ferrite", "loops"),
        ("sample", "A/m", "T"),
        ("loops:1",),
        options=SETTLED,
        laws=MAGNETIC,
    ),
    Device(
        "shape memory alloy, later cycles",
        _in("sma-isobaric-tamu", "thermal_cycles"),
        ("sample", "degC", "1"),
        ("thermal_cycles:24", "thermal_cycles:48"),
        options=DiagnosisOptions(settle=True, flip=True, input_offset=130.0),
        laws=(*SWITCHING, "energy-based", "jiles-atherton-clamped"),
        prepared=_smoothed((8, 16, 24, 32, 40, 48), 9),
    ),
    Device(
        "friction damper, 12.7 mm from 38.1 mm",
        _in("friction-damper-brfd", f"{BRFD}12p7mm", f"{BRFD}38p1mm"),
        ("s", "m", "N"),
        (f"{BRFD}12p7mm",),
        stride=3,
        laws=FRICTION,
    ),
    Device(
        "steel coupon S355, growing cycles",
        _in("steel-coupon-rlmtp", "s355_c12_growing_cycles"),
        ("s", "1", "Pa"),
        stride=3,
        laws=FRICTION,
        prepared=_first(7789),
    ),
    Device("steel coupon S355J2", _in("steel-coupon-resslab", "example_1"), ("sample", "1", "Pa"), laws=FRICTION),
    Device(
        "MR damper, 0.87 V",
        _in("mr-damper-utfpr", "sine_runs_0p87V"),
        ("s", "m", "N"),
        third=True,
        stride=4,
        laws=FRICTION,
    ),
    Device(
        "pneumatic cylinder, O-ring, 1 bar",
        _in("pneumatic-friction-tud", "oring_1bar"),
        ("s", "m", "N"),
        stride=3,
        laws=FRICTION,
    ),
    Device(
        "timber wall",
        _in("clt-wall-actuator", "trial2"),
        ("sample", "m", "N"),
        stride=3,
        laws=FRICTION,
        prepared=_first(7100),
    ),
    Device("rocking wall", _in("rocking-wall-ts1", "ts1_cyclic"), ("sample", "m", "N"), laws=FRICTION),
    Device(
        "battery electrode",
        _in("battery-ocv-silicon-graphite", "half_cell_0C02"),
        ("s", "1", "V"),
        stride=3,
        laws=GENERAL,
    ),
    Device(
        "linear capacitor, 700 Hz",
        _in("linear-capacitor-reference", "frequency_loops_3V"),
        FILM,
        ("frequency_loops_3V:4",),
        laws=GENERAL,
        effects=("transport-delay",),
        prepared=_runs(ABOVE),
    ),
    Device(
        "Bouc-Wen benchmark (synthetic)",
        _in("boucwen-benchmark", "train_multisine"),
        ("s", "N", "m"),
        laws=("oscillator", "hammerstein"),
    ),
)


def records_of(device: Device) -> Dataset:
    """As `compare` gets them."""
    records = load(*(DATA / file for file in device.files)).records
    units = dict(zip(("time", "input", "output"), device.units, strict=True))
    kept = device.prepared([replace(r, units=units) for r in records])
    kept = [record.take(slice(None, None, device.stride)) for record in kept if record.measured.size >= FEW]
    held_out = tuple(record.name for record in kept[1::3]) if device.third else device.held_out
    return with_held_out(Dataset(tuple(kept), held_out))[0]


def compared(device: Device) -> pd.DataFrame:
    begun = time.time()
    dataset = records_of(device)
    found = compare(dataset, device.laws, device.effects, options=replace(device.options, jobs=1))
    span = max(float(r.measured.max() - r.measured.min()) for r in dataset.held_out)
    told = {"device": device.name, "unit": device.units[2], "chosen": found.chosen, "floor": found.floor, "span": span}
    print(f"{device.name}: {found.words} ({time.time() - begun:.0f} s)", flush=True)
    return found.table.drop(columns="seconds").assign(**told)


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
    """A row a device, also of those that were not run: the chosen law, what it and the polynomial leave, the floor."""
    found = []
    for device in DEVICES:
        part = rows[rows["device"] == device.name].set_index("law") if len(rows) else rows
        row = {"device": device.name, "unit": device.units[2], "run": "yes" if len(part) else "not run"}
        if len(part):
            law = part["chosen"].iloc[0] or BASELINE
            errors = {"held_out": part.loc[law, "held_out"], "polynomial": part.loc[BASELINE, "held_out"]}
            row |= {"law": law, **errors, "floor": part["floor"].iloc[0], "range": part["span"].iloc[0]}
        found.append(row)
    return pd.DataFrame(found)


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "measured-laws")
    given = parser.parse_args(arguments)
    path = given.out / NUMBERS
    rows = pd.read_csv(path, keep_default_na=True).fillna({"chosen": ""}) if path.is_file() else pd.DataFrame()
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
