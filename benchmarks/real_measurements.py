"""Diagnosis of measurements: the error before and after on records that were not fitted.

    python benchmarks/real_measurements.py [NAME ...] [--out results/real-measurements]

Looks for the data in the folder that HYSTERESIS_DATA names, or in ../shared/data beside the checkout. What it keeps
is derived: numbers, bars of errors, a page. Cases that are there already are kept; name one to diagnose it again.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import diagnosed_page
import measured_page
import numpy as np
import pandas as pd

from hysteresis_bench import load
from hysteresis_bench.diagnosis.diagnose import diagnose
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.question import DiagnosisOptions, Question
from hysteresis_bench.report.diagnosis.figures import bars_of, waterfall
from hysteresis_bench.report.diagnosis.in_print import first_sentence, in_print, unit_in_print
from hysteresis_bench.report.shared.blocks import (
    ESTIMATE_HEADER,
    ESTIMATE_NOTE,
    Block,
    Cell,
    Figures,
    Paragraph,
    Table,
    estimate_cells,
)
from hysteresis_bench.report.shared.page import Page, Section, files_beside
from hysteresis_bench.report.shared.text import NONE, listed, number, sentence
from hysteresis_bench.signals import Dataset, Record

ROOT = Path(__file__).parent.parent
DATA = Path(os.environ.get("HYSTERESIS_DATA", ROOT.parent / "shared" / "data"))
NUMBERS, STEPS, LAWS, FOUND, PAGE = "numbers.csv", "steps.csv", "laws.csv", "diagnosed.csv", "report.html"
STAND_IN = " (stand-in)"
"""Behind the names of steps that may stand in for the law."""
BEFORE_LAWS = "What one model that was given lacks, as a diagnosis says that does not look for the law."


@dataclass(frozen=True)
class Case:
    """One question to one device's records.

    units : of time (sample: only an index), input and output
    runs : which of the file's records, all where empty;  held_out : of them, not fitted
    smooth : samples of a centred running mean over the input, where the input is noisy
    known : what the source says of these data, in a sentence
    """

    name: str
    device: str
    files: tuple[str, ...]
    units: tuple[str, str, str]
    model: str
    known: str
    runs: tuple[str, ...] = ()
    held_out: tuple[str, ...] = ()
    smooth: int = 1
    effects: tuple[str, ...] = ()
    options: DiagnosisOptions = field(default_factory=DiagnosisOptions)


PIEZO = ("piezo-picma-ntu/full_amplitude_1Hz.csv", "piezo-picma-ntu/modulated_1Hz_ramp_down.csv")
CAPACITOR, PZT, HFO2, FEFET = (
    f"{folder}/frequency_loops_{volts}V"
    for folder, volts in (
        ("linear-capacitor-reference", 3),
        ("ferroelectric-pzt-film-a", 8),
        ("ferroelectric-hfo2-film", 4),
        ("ferroelectric-fefet-stack", 5),
    )
)


def _runs(file: str, numbers: Sequence[int]) -> tuple[str, ...]:
    return tuple(f"{Path(file).stem}:{run}" for run in numbers)


CASES = (
    Case(
        "piezo",
        "piezo stack PI PICMA P-885.91, voltage to displacement",
        PIEZO,
        ("s", "V", "um"),
        "bouc-wen",
        "1 Hz only, so that rate dependence cannot show; the first 0.5 s are a switch-on transient; the sensor's "
        "noise is 0.065 µm; offsets differ between records",
        held_out=("modulated_1Hz_ramp_down",),
        options=DiagnosisOptions(skip=0.5),
        effects=("record-offset",),
    ),
    Case(
        "piezo, several amplitudes fitted",
        "piezo stack PI PICMA P-885.91, voltage to displacement",
        PIEZO,
        ("s", "V", "um"),
        "bouc-wen",
        "the same records, but the one whose amplitude changes is fitted and the one of full amplitude held out",
        held_out=("full_amplitude_1Hz",),
        options=DiagnosisOptions(skip=0.5),
        effects=("record-offset",),
    ),
    Case(
        "piezo, each record's own drift",
        "piezo stack PI PICMA P-885.91, voltage to displacement",
        PIEZO,
        ("s", "V", "um"),
        "bouc-wen",
        "as before, with one straight line in time a record beside its offset, before and after: the full-amplitude "
        "record drifts by half a micrometre, the other does not",
        held_out=("full_amplitude_1Hz",),
        options=DiagnosisOptions(skip=0.5),
        effects=("record-offset", "record-drift"),
    ),
    Case(
        "piezo, within one record",
        "piezo stack PI PICMA P-885.91, voltage to displacement",
        PIEZO[:1],
        ("s", "V", "um"),
        "bouc-wen",
        "the first two thirds of the full-amplitude record fitted, the last third predicted",
        options=DiagnosisOptions(skip=0.5),
        effects=("record-offset",),
    ),
    Case(
        "capacitor, 400 Hz and above",
        "2.2 nF capacitor on a ferroelectric tester, voltage to charge",
        (f"{CAPACITOR}.csv",),
        ("s", "V", "C/m^2"),
        "bouc-wen",
        "no hysteresis; the tester delays the charge by about 13 µs from 400 Hz up",
        runs=_runs(CAPACITOR, (2, 3, 4, 5, 6)),
        held_out=_runs(CAPACITOR, (4,)),
    ),
    Case(
        "capacitor, all frequencies",
        "2.2 nF capacitor on a ferroelectric tester, voltage to charge",
        (f"{CAPACITOR}.csv",),
        ("s", "V", "C/m^2"),
        "bouc-wen",
        "no hysteresis; the tester's delay jumps from 1 to 13 µs between 200 and 400 Hz, where it changes its range",
        held_out=_runs(CAPACITOR, (1, 4)),
    ),
    Case(
        "electrical steel",
        "grain-oriented electrical steel M130-27s, field to flux density",
        ("magcore-go-steel-m130/loops.csv",),
        ("sample", "A/m", "T"),
        "jiles-atherton-clamped",
        "two closed loops without a time base",
        held_out=("loops:0",),
        options=DiagnosisOptions(settle=True),
    ),
    Case(
        "Mn-Zn ferrite",
        "Mn-Zn ferrite core, field to flux density",
        ("magcore-mnzn-ferrite/loops.csv",),
        ("sample", "A/m", "T"),
        "jiles-atherton-clamped",
        "three closed loops without a time base, made symmetric by their author",
        held_out=("loops:1",),
        options=DiagnosisOptions(settle=True),
    ),
    Case(
        "PZT film",
        "lead zirconate titanate film, voltage to polarization",
        (f"{PZT}.csv",),
        ("s", "V", "C/m^2"),
        "free-energy",
        "triangles of 100 to 1000 Hz after a pulse that is not recorded; the tester delays by 1 to 13 µs",
        runs=_runs(PZT, (2, 3, 4, 5, 6)),
        held_out=_runs(PZT, (4,)),
        options=DiagnosisOptions(settle=True),
    ),
    Case(
        "hafnium oxide film",
        "hafnium oxide film, voltage to polarization",
        (f"{HFO2}.csv",),
        ("s", "V", "C/m^2"),
        "free-energy",
        "triangles of 100 to 1000 Hz; a leaky film, whose loops need not close",
        runs=_runs(HFO2, (2, 3, 4, 5, 6)),
        held_out=_runs(HFO2, (4,)),
        options=DiagnosisOptions(settle=True),
    ),
    Case(
        "FeFET gate stack",
        "metal-ferroelectric-silicon gate stack, voltage to polarization",
        (f"{FEFET}.csv",),
        ("s", "V", "C/m^2"),
        "free-energy",
        "triangles of 100 to 1000 Hz; asymmetric loops, open at zero volts",
        runs=_runs(FEFET, (2, 3, 4, 5, 6)),
        held_out=_runs(FEFET, (4,)),
        options=DiagnosisOptions(settle=True),
    ),
    Case(
        "shape memory alloy",
        "shape memory alloy under constant stress, temperature to strain",
        ("sma-isobaric-tamu/thermal_cycles.csv",),
        ("sample", "degC", "1"),
        "jiles-atherton-clamped",
        "six of about 70 cycles without a time base; strain falls on heating, so the input is flipped about 130 °C; "
        "the thermocouple is noisy, so the input is a running mean of 9 samples; the loop moves from cycle to cycle",
        runs=tuple(f"thermal_cycles:{run}" for run in (8, 16, 24, 32, 40, 48)),
        held_out=("thermal_cycles:24", "thermal_cycles:48"),
        smooth=9,
        effects=("record-offset",),
        options=DiagnosisOptions(settle=True, flip=True, input_offset=130.0),
    ),
)


def prepared(case: Case) -> Dataset:
    """The case's records, as `diagnose` gets them."""
    dataset = load(*(DATA / file for file in case.files))
    records = [record for record in dataset.records if not case.runs or record.name in case.runs]
    units = dict(zip(("time", "input", "output"), case.units, strict=True))
    return Dataset(tuple(replace(_smoothed(r, case.smooth), units=units) for r in records), case.held_out)


def _smoothed(record: Record, width: int) -> Record:
    if width == 1:
        return record
    padded = np.pad(record.input, width // 2, mode="edge")
    return replace(record, input=np.convolve(padded, np.full(width, 1.0 / width), mode="valid"))


def row(case: Case, found: Diagnosis, seconds: float) -> dict[str, Any]:
    """What is kept of a diagnosis: numbers and names."""
    own = {*found.effects, "record-offset"}
    values = {
        name: [estimate.value, estimate.standard_error, estimate.unit]
        for name, estimate in found.model.parameters.items()
        if name.rpartition(".")[0] in own or name in own
    }
    before, after = found.before, found.after
    return {
        "case": case.name,
        "model": case.model,
        "verdict": found.verdict,
        "effects": " ".join(found.effects),
        "stand_ins": " ".join(found.stand_ins),
        "ties": "; ".join(f"{tie.effect} or {tie.rival}" for tie in found.ties),
        "hysteresis_needed": found.memory.needed,
        "hysteresis": found.memory.words,
        "noise": found.noise.floor,
        "fitted_before": before.fitted.rmse,
        "fitted_after": after.fitted.rmse,
        "held_out_before": before.held_out.rmse if before.held_out else None,
        "held_out_after": after.held_out.rmse if after.held_out else None,
        "unit": found.units.get("output", "1"),
        "parameters": json.dumps(values),
        "advice": found.advice.words if found.advice else "",
        "headline": found.headline,
        "seconds": round(seconds, 1),
    }


def read(path: Path) -> list[dict[str, str]]:
    if not path.is_file():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write(path: Path, rows: Sequence[Mapping[str, Any]]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        columns = dict.fromkeys(name for row in rows for name in row)  # older rows lack some
        writer = csv.DictWriter(file, list(columns), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def page(folder: Path, rows: Sequence[Mapping[str, str]], steps: Sequence[Mapping[str, str]]) -> Path:
    """Write report.html from the numbers kept."""
    laws = measured_page.read(folder / LAWS) if (folder / LAWS).is_file() else None
    parts = []
    for one in rows:
        case = next((case for case in CASES if case.name == one["case"]), None)
        if case is not None:
            parts.append(_section(folder, case, one, [step for step in steps if step["case"] == case.name]))
    how = (
        "By benchmarks/laws.py, benchmarks/diagnosed.py and benchmarks/real_measurements.py. The measurements are not "
        "part of the project; only what is derived from them is kept here."
    )
    beside = {LAWS: "a row a device"} if laws is not None else {}
    beside |= {NUMBERS: "a row a diagnosis", STEPS: "error step by step"}
    if (folder / FOUND).is_file():
        beside |= {FOUND: "a row a device, with nothing given"}
    made = Section("made", "How it was made", [how, files_beside(beside)])
    diagnoses = Section("summary", "Diagnoses of one given model", [BEFORE_LAWS, _summary(rows, steps)])
    sections = [diagnoses, *parts, made]
    if laws is None:
        title, kicker = "Diagnosis of real measurements", f"{len(parts)} questions"
        return Page(title, kicker, sections, contents=True).write(folder / PAGE)
    noise: dict[str, float] = {}
    if (folder / FOUND).is_file():
        found = diagnosed_page.read(folder / FOUND)
        noise = dict(zip(found["device"], found["floor"], strict=True))
        sections = [_with_nothing_given(found, laws), *sections]
    sections = [measured_page.section(folder, laws, noise), *sections]
    kicker = "Laws and diagnoses of measured devices"
    return Page("Real measurements", kicker, sections, measured_page.answer(laws), contents=True).write(folder / PAGE)


def _with_nothing_given(found: pd.DataFrame, laws: pd.DataFrame) -> Section:
    """The diagnoses of measured devices, as `diagnosed_page` has them; those of synthetic data in a sentence each."""
    real = measured_page.measured(found)
    told = diagnosed_page.section(real, measured_page.measured(laws))
    made = [_made(row) for _, row in found.drop(real.index).iterrows()]
    return Section(told.anchor, told.heading, [*told.blocks, *made])


def _made(row: pd.Series) -> str:
    """What was found of synthetic data."""
    named = listed(row["effects"].split()) if row["effects"] else "no effect"
    errors = [f"{number(row[which], 3)} {unit_in_print(row['unit'])}" for which in ("before", "after")]
    return (
        f"{row['device']}, not counted above: the law is {row['law']}, {named} is named, held out the RMSE is "
        f"{errors[0]} before and {errors[1]} after, in {number(row['seconds'] / 60, 2)} minutes."
    )


def _section(folder: Path, case: Case, one: Mapping[str, str], steps: Sequence[Mapping[str, str]]) -> Section:
    """A case: what is known of the device, what was found, step by step."""
    held_out = (_float(one["held_out_before"]), _float(one["held_out_after"]))
    bars = bars_of([(step["step"], float(step["rmse"])) for step in steps], held_out)
    name = "".join(c for c in case.name if c.isalnum())
    drawn, parameters = waterfall(folder, bars, units={"output": one["unit"]}, name=name), _parameters(one)
    ties = [f"These records do not tell apart: {one['ties']}."] if one["ties"] else []
    advice = [in_print(one["advice"])] if one["advice"] else []
    first, others = first_sentence(in_print(one["headline"]))
    blocks: list[Block] = [Paragraph(sentence(f"{case.device}: {case.known}"), "note"), Paragraph(first, "strong")]
    blocks += [*([others] if others else []), in_print(sentence(one["hysteresis"])), *ties, *advice, Figures([drawn])]
    tables = [parameters] if parameters.rows else []
    return Section(f"case-{name}", f"{case.name[0].upper()}{case.name[1:]}", [*blocks, *tables])


def _summary(rows: Sequence[Mapping[str, str]], steps: Sequence[Mapping[str, str]]) -> Table:
    lines: list[list[str | Cell]] = []
    for one in rows:
        before, after = _float(one["held_out_before"]), _float(one["held_out_after"])
        gain = before / after if before and after else None
        lines.append(
            [
                one["case"],
                one["model"],
                Cell(_names(one), "prose"),
                Cell(listed(stand_ins(one, steps)) if stand_ins(one, steps) else NONE, "prose"),
                "yes" if one["hysteresis_needed"] == "True" else "no",
                number(before, 3),
                Cell(number(after, 3), "", strong=True),
                Cell(number(gain, 3), "bad" if gain is not None and gain < 1.0 else ""),
                number(_float(one["noise"]), 2),
                unit_in_print(one["unit"]) if one["unit"] != "1" else "",
            ]
        )
    header = [
        "Case",
        "Model",
        "Named",
        "For the law",
        "Hysteresis needed",
        "Before",
        "After",
        "Before/after",
        "Noise",
        "Unit",
    ]
    note = (
        "For the law: what was adopted too, acts in “after”, and is not named, as it may stand in for what is wrong "
        "with the law. Before/after below 1: what was adopted predicts these records worse. The noise is estimated "
        "from the fitted records alone, before any law; they are not those of the tables above."
    )
    return Table("RMSE on records that were not fitted", header, lines, note=note)


def stand_ins(one: Mapping[str, str], steps: Sequence[Mapping[str, str]]) -> list[str]:
    """What was adopted and may stand in for the law; of rows that do not say so, from the steps of the error."""
    if one.get("stand_ins"):
        return one["stand_ins"].split()
    labels = [step["step"] for step in steps if step["case"] == one["case"]]
    offsets = [offset for label in labels[:1] if (offset := label.partition(" with a ")[2])]
    return [label.removesuffix(STAND_IN) for label in labels if label.endswith(STAND_IN)] + offsets


def _names(one: Mapping[str, str]) -> str:
    """The adopted effects, those that are tied with others marked."""
    tied = {pair.partition(" or ")[0] for pair in one["ties"].split("; ")}
    names = [f"{name} or its like" if name in tied else name for name in one["effects"].split()]
    return listed(names) if names else "none"


def _parameters(one: Mapping[str, str]) -> Table:
    rows = [
        estimate_cells(name, value, error, unit=unit_in_print(unit), digits=4)
        for name, (value, error, unit) in json.loads(one["parameters"]).items()
    ]
    note = f"{ESTIMATE_NOTE} What is red has an error larger than its value: these data do not determine it."
    return Table("Parameters of the effects", ESTIMATE_HEADER, rows, note)


def _float(text: Any) -> float | None:
    return float(text) if text not in ("", None) else None


def main(say: Callable[[str], None] = print) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="cases to diagnose again; default: those that are missing")
    parser.add_argument("--out", type=Path, default=ROOT / "results" / "real-measurements")
    arguments = parser.parse_args()
    folder: Path = arguments.out
    folder.mkdir(parents=True, exist_ok=True)
    order = [case.name for case in CASES]
    rows = {one["case"]: one for one in read(folder / NUMBERS)}
    steps = read(folder / STEPS)
    for case in CASES:
        if case.name not in arguments.names if arguments.names else case.name in rows:
            continue
        begun = time.monotonic()
        found = diagnose(prepared(case), Question(case.model, case.effects, options=case.options))
        rows[case.name] = {
            key: str(v) if v is not None else "" for key, v in row(case, found, time.monotonic() - begun).items()
        }
        steps = [step for step in steps if step["case"] != case.name]
        steps += [{"case": case.name, "step": label, "rmse": repr(value)} for label, value in found.waterfall]
        write(folder / NUMBERS, sorted(rows.values(), key=lambda one: order.index(one["case"])))
        write(folder / STEPS, sorted(steps, key=lambda step: order.index(step["case"])))
        say(f"{case.name}: {found.headline}")
    say(str(page(folder, read(folder / NUMBERS), read(folder / STEPS))))


if __name__ == "__main__":
    main()
