"""Were the probabilities right that were told with names?"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hysteresis_bench.diagnosis_study.case import Case
from hysteresis_bench.report.diagnosis_study.figures import reliability_diagram
from hysteresis_bench.report.diagnosis_study.reliability import BINS, Bin, reliability
from hysteresis_bench.report.shared.blocks import Cell, Figures, Table
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import number, percent, whole
from hysteresis_bench.statistics import wilson

SOMEWHAT = 0.05
"""Gap between the share of right claims and the probability told up to which it is only somewhat off."""


def sure_in_words(cases: Sequence[Case]) -> str:
    """What was told on average, how many were right, and whether that is too sure or too careful; empty without claims.

    Off is what lies beyond the 95 % interval of the share.
    """
    bins = reliability(cases)
    if not bins:
        return ""
    claims, right = sum(one.claims for one in bins), sum(one.right for one in bins)
    told = _told(bins)
    low, high = wilson(right, claims)
    verdict = "too sure" if told > high else "too careful" if told < low else ""
    little = "somewhat " if abs(right / claims - told) < SOMEWHAT else ""
    said = (
        f"{little}{verdict}"
        if verdict
        else "neither too sure nor too careful, within what chance does to so many claims"
    )
    return (
        f"On average claims were told to be right with a probability of {percent(told)}, and "
        f"{percent(right / claims)} were ({whole(right)} of {whole(claims)}): {said}."
    )


def sure_section(folder: Path, cases: Sequence[Case]) -> list[Section]:
    """Diagram and table; no section where no probability was told."""
    bins = reliability(cases)
    if not bins:
        return []
    claims, right = sum(one.claims for one in bins), sum(one.right for one in bins)
    header = ["Probability told", "Claims", "Mean told", "Right", "95\u202f% interval", "Right less told"]
    kept = "One bin" if len(bins) == 1 else f"{len(bins)} bins"
    fewer = f" {kept} in the place of {BINS}: claims told alike share a bin." if len(bins) < BINS else ""
    note = (
        "Right: of the claims, those whose effect was hidden, or one tied with it, or of whose family one was hidden "
        "where the family was told with its curve; red where fewer were than chance allows for what was told. Right "
        f"less told: percentage points; above zero the program was too careful. Intervals are Wilson's.{fewer}"
    )
    points = 100.0 * (right / claims - _told(bins))
    way = "more" if points >= 0 else "fewer"
    said = (
        f"{whole(claims)} claims: {number(abs(points), 2)} percentage points {way} were right than was told on average."
    )
    table = Table("Claims by probability", header, [_bin(one) for one in bins], note)
    return [Section("sure", "How sure, and how right", [said, Figures([reliability_diagram(folder, bins)]), table])]


def _told(bins: Sequence[Bin]) -> float:
    """Mean probability of all claims."""
    return sum(one.claims * one.told for one in bins) / sum(one.claims for one in bins)


def _bin(one: Bin) -> list[str | Cell]:
    low, high = wilson(one.right, one.claims)
    share = one.right / one.claims
    bounds = percent(one.low) if one.low == one.high else f"{percent(one.low)} to {percent(one.high)}"
    return [
        bounds,
        whole(one.claims),
        percent(one.told),
        Cell(percent(share), tone(one.told, low, high)),
        f"{percent(low)} to {percent(high)}",
        number(100.0 * (share - one.told), 2),
    ]


def tone(told: float, low: float, high: float) -> str:
    """Of a share, by its interval: bad only where more was told than came true."""
    return "bad" if told > high else "good" if told >= low else ""
