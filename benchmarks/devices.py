"""The measured devices whose records the laws are compared on: files, units, split, and what was asked of each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from real_measurements import DATA

from hysteresis_bench import load
from hysteresis_bench.diagnosis.preparation import with_held_out
from hysteresis_bench.diagnosis.question import DiagnosisOptions
from hysteresis_bench.signals import Dataset, Record

FEW = 40
"""Scored samples below which a run is left out, such as the first of reversal curves."""


WAY = 10
"""Samples of a way that was not recorded."""
PLAIN, SETTLED = DiagnosisOptions(), DiagnosisOptions(settle=True)


MAGNETIC = ("preisach-hats", "preisach", "energy-based", "jiles-atherton-clamped", "jiles-atherton-pinning")
REVERSAL = ("preisach-hats", "preisach", "energy-based")
SWITCHING = ("preisach-hats", "preisach", "ferroelectric", "prandtl-ishlinskii", "prandtl-ishlinskii-modified")
FRICTION = ("maxwell-slip", "dahl", "lugre", "bouc-wen", "preisach")
YIELDING = (
    "bouc-wen-generalized",
    "preisach-hats",
    "chaboche",
    "chaboche-bowed",
    "folz-filiatrault",
    "pinching",
    "self-centring",
)
STRUCTURE = (*FRICTION, *YIELDING)
GENERAL = (*SWITCHING, "energy-based", "bouc-wen", "bouc-wen-generalized", "dahl", "maxwell-slip")
"""Laws that are compared on a kind of device: those of its own field, and the general ones."""
ANHYSTERETIC, SHAPE = ("output-curve",), ("input-curve", "output-curve")
"""What a law's shape may lack: that of a magnet without hysteresis is no Langevin function, of a transformation between
two strains neither end need be like the law's."""


@dataclass(frozen=True)
class Device:
    """units : of time (sample: only an index), input and output;  held_out : names of runs, the last third where empty
    third : every third run is held out;  stride : every n-th sample is kept
    laws : that are compared, all where empty;  effects : that the source of the data says act
    perhaps : further ones that may act; they stay where what was left out is predicted better with them
    prepared : what the data's source asks for before a model sees them
    asked : RMSE that was asked for, in the unit of the output, as a share of the held-out range where `share`
    repeats : by how much equal cycles of the device differ, in words
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
    perhaps: tuple[str, ...] = ()
    prepared: Callable[[list[Record]], list[Record]] = list
    asked: float | None = None
    share: bool = False
    repeats: str = ""


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
        perhaps=("drift",),
        asked=0.15,
    ),
    *(
        Device(
            f"{name}, 700 Hz",
            _in(folder, file),
            FILM,
            (f"{file}:4",),
            options=options,
            laws=SWITCHING,
            effects=("threshold-rate", "transport-delay"),
            perhaps=("leakage", "drift", *more),
            prepared=_runs(ABOVE),
            asked=asked,
            repeats=repeats,
        )
        for name, folder, file, options, asked, repeats, more in (
            ("PZT film", "ferroelectric-pzt-film-a", "frequency_loops_8V", SETTLED, 0.0018, "", ()),
            # its outputs end 16 % of their range away from where they began; a part of the voltage falls on the
            # silicon, by a curve of it
            ("FeFET stack", "ferroelectric-fefet-stack", "frequency_loops_5V", PLAIN, 0.0020, "", ("input-curve",)),
            ("HfO2 film", "ferroelectric-hfo2-film", "frequency_loops_4V", SETTLED, None, "0.014 to 0.017", ()),
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
        asked=0.003,
        share=True,
    ),
    Device(
        "FeCo reversal curves",
        _in("forc-feco-nanowires", "forc"),
        ("sample", "A/m", "A m^2"),
        third=True,
        laws=REVERSAL,
        prepared=_from_saturation(1.194e6),
        asked=0.003,
        share=True,
    ),
    Device(
        "rock reversal curves",
        _in("forc-rock-agm", "forc"),
        ("sample", "A/m", "A m^2"),
        third=True,
        laws=REVERSAL,
        prepared=_from_saturation(2.39e5),
    ),
    Device(
        "electrical steel, one loop",
        _in("magcore-go-steel-m130", "loops"),
        ("sample", "A/m", "T"),
        ("loops:0",),
        options=SETTLED,
        laws=MAGNETIC,
        perhaps=ANHYSTERETIC,
        asked=0.0449,
    ),
    Device(
        "Mn-Zn ferrite, one loop",
        _in("magcore-mnzn-ferrite", "loops"),
        ("sample", "A/m", "T"),
        ("loops:1",),
        options=SETTLED,
        laws=MAGNETIC,
        perhaps=ANHYSTERETIC,
        asked=0.00378,
    ),
    Device(
        "shape memory alloy, later cycles",
        _in("sma-isobaric-tamu", "thermal_cycles"),
        ("sample", "degC", "1"),
        ("thermal_cycles:24", "thermal_cycles:48"),
        options=DiagnosisOptions(settle=True, flip=True, input_offset=130.0),
        laws=(*GENERAL, "jiles-atherton-clamped"),
        perhaps=SHAPE,
        prepared=_smoothed((8, 16, 24, 32, 40, 48), 9),
        asked=0.0009,
        repeats="0.0006 to 0.0008",
    ),
    Device(
        "friction damper, 12.7 mm from 38.1 mm",
        _in("friction-damper-brfd", f"{BRFD}12p7mm", f"{BRFD}38p1mm"),
        ("s", "m", "N"),
        (f"{BRFD}12p7mm",),
        stride=3,
        laws=FRICTION,
        asked=1200.0,
        repeats="1.0 to 3.4 % of range",
    ),
    Device(
        "steel coupon S355, growing cycles",
        _in("steel-coupon-rlmtp", "s355_c12_growing_cycles"),
        ("s", "1", "Pa"),
        stride=3,
        laws=STRUCTURE,
        prepared=_first(7789),
        asked=1.33e7,
    ),
    Device(
        "steel coupon S355J2",
        _in("steel-coupon-resslab", "example_1"),
        ("sample", "1", "Pa"),
        laws=STRUCTURE,
        asked=1.5e7,
    ),
    Device(
        "MR damper, 0.87 V",
        _in("mr-damper-utfpr", "sine_runs_0p87V"),
        ("s", "m", "N"),
        third=True,
        stride=4,
        laws=FRICTION,
        asked=0.042,
        share=True,
        repeats="0.5 to 1.4 % of range",
    ),
    Device(
        "pneumatic cylinder, O-ring, 1 bar",
        _in("pneumatic-friction-tud", "oring_1bar"),
        ("s", "m", "N"),
        perhaps=("late-input",),
        stride=4,
        laws=FRICTION,
        asked=0.015,
        share=True,
        repeats="0.25 to 0.5 % of range",
    ),
    Device(
        "timber wall",
        _in("clt-wall-actuator", "trial2"),
        ("sample", "m", "N"),
        stride=3,
        laws=STRUCTURE,
        prepared=_first(7100),
        asked=0.0078,
        share=True,
        repeats="0.26 % of range",
    ),
    Device(
        "rocking wall",
        _in("rocking-wall-ts1", "ts1_cyclic"),
        ("sample", "m", "N"),
        laws=STRUCTURE,
        asked=0.009,
        share=True,
        repeats="0.1 to 0.3 % of range",
    ),
    Device(
        "battery electrode",
        _in("battery-ocv-silicon-graphite", "half_cell_0C02"),
        ("s", "1", "V"),
        stride=3,
        laws=GENERAL,
        asked=0.01,
        share=True,
    ),
    Device(
        "linear capacitor, 700 Hz",
        _in("linear-capacitor-reference", "frequency_loops_3V"),
        FILM,
        ("frequency_loops_3V:4",),
        laws=GENERAL,
        effects=("transport-delay",),
        prepared=_runs(ABOVE),
        asked=2.27e-5,
    ),
    Device(
        "Bouc-Wen benchmark (synthetic)",
        _in("boucwen-benchmark", "train_multisine"),
        ("s", "N", "m"),
        laws=("oscillator", "hammerstein"),
        asked=8.5e-6,
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
