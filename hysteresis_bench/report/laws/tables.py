"""The figure and the table of laws: what each predicts of what it did not see."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from hysteresis_bench.diagnosis.laws.comparison import BASELINE
from hysteresis_bench.report.shared.blocks import Cell, Table
from hysteresis_bench.report.shared.text import NONE, Units, named, number
from hysteresis_bench.report.shared.theme import MUTED, SERIES, Picture, numbers_beside, picture

UNSEEN, HELD_OUT, WITHOUT, FLOOR = SERIES[0], SERIES[3], MUTED, SERIES[2]

AROUND = (
    " With an effect: what is left out, by the law with what helps it most: a drift of every record, lags of any "
    "weights before or after it, or, where all laws stayed far from the noise, a curve, plays, an overshoot or a "
    "change with time; a law with dynamics of its own has such effects in itself. By these the laws were ranked."
)

Laws = Sequence[Mapping[str, Any]]
"""Rows as `Comparison.as_dict` has them: the best first, absent numbers None."""


def laws_figure(folder: Path, laws: Laws, *, floor: float, units: Units, name: str = "laws") -> Picture:
    """RMSE of every law on a logarithmic axis, beside the polynomial without memory and the noise."""
    shown = fitted_ones(laws)

    def draw(figure: Any) -> None:
        draw_laws(figure.add_subplot(), laws, floor, units)

    told = ", ".join(f"{law['law']} {law['unseen']:.3g}" for law in shown)
    caption = (
        "Error of every law on what was left out of its fit, and on what was held out from all of them. The cubic "
        "polynomial of the input has no memory: a law that does not beat it has found no hysteresis."
    )
    size = (5.4, 1.3 + 0.27 * len(shown))
    return picture(folder, name, size, alt=f"RMSE of every law: {told}.", caption=caption, draw=draw)


def draw_laws(axes: Any, laws: Laws, floor: float, units: Units) -> None:
    """The rows of `laws_figure`."""
    shown = fitted_ones(laws)
    for row, law in enumerate(shown):
        without = law["law"] == BASELINE
        axes.plot(law["unseen"], row, "o", color=WITHOUT if without else UNSEEN, markersize=6, zorder=3)
        if law["held_out"] is not None:
            axes.plot(law["held_out"], row, "D", color=HELD_OUT, markersize=5, zorder=4)
    axes.axvline(floor, color=FLOOR, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
    axes.plot([], [], "o", color=UNSEEN, label="left out of its fit")
    columns = [("left out", UNSEEN, {row: number(law["unseen"], 3) for row, law in enumerate(shown)})]
    if any(law["held_out"] is not None for law in shown):
        columns.append(("held out", HELD_OUT, {row: number(law["held_out"], 3) for row, law in enumerate(shown)}))
        axes.plot([], [], "D", color=HELD_OUT, label="held out")
    axes.plot([], [], color=FLOOR, linestyle=(0, (4, 3)), label="noise")
    numbers_beside(axes, columns)
    axes.set_xscale("log")
    _few_ticks(axes)
    axes.set_yticks(range(len(shown)), [law["law"] for law in shown])
    axes.set_ylim(len(shown) - 0.5, -0.9)
    axes.set_xlabel(named("RMSE", units, "output"))
    axes.figure.legend(loc="outside upper left", ncols=3, handlelength=1.4)


def _few_ticks(axes: Any) -> None:
    """At 1, 2 and 5 of every decade, where there are few: more labels run into each other beside the columns."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    lower, upper = axes.get_xlim()
    if upper < 50.0 * lower:
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=12))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def fitted_ones(laws: Laws) -> list[Mapping[str, Any]]:
    """Those that could be fitted."""
    return [law for law in laws if law["unseen"] is not None]


def laws_table(laws: Laws, chosen: str | None, floor: float, units: Units) -> Table:
    """Every law, the best first."""
    held_out = any(law["held_out"] is not None for law in laws)
    rmse = named("RMSE", units, "output")
    header = ["Law", "Parameters", f"{rmse}, left out", "times the noise", "fitted"]
    around = any(law.get("around") is not None for law in laws)
    header += [*(["held out"] if held_out else []), *(["left out, with an effect"] if around else []), "CPU seconds"]
    rows = []
    for law in fitted_ones(laws):
        mine = law["law"] == chosen
        cells: list[str | Cell] = [
            Cell(law["law"], "quiet" if law["law"] == BASELINE else "", strong=mine),
            str(law["parameters"]),
            Cell(number(law["unseen"], 3), "", strong=mine),
            number(law["unseen"] / floor, 3) if floor > 0.0 else NONE,
            number(law["fitted"], 3),
        ]
        cells += [number(law["held_out"], 3)] if held_out else []
        cells += [NONE if law["around"] is None else number(law["around"], 3)] if around else []
        rows.append([*cells, number(law["seconds"], 2)])
    return Table(
        "Laws",
        header,
        rows,
        note="Left out: what stays in the range of the rest is predicted by a fit to that, whole records or parts of a "
        "lone one; of what goes further, blocks are left out. Parameters of a smooth density are counted as effective "
        "ones. Each record has an offset of its own. What is held out is predicted and chooses nothing."
        + (AROUND if around else ""),
    )


def not_fitted(laws: Laws) -> list[str]:
    """A sentence for every law that could not be fitted."""
    return [f"{law['law']}: {law['reason']}" for law in laws if law["reason"]]
