"""Sentences of a diagnosis, which are written in plain letters for every file and terminal, as a page prints them."""

from __future__ import annotations

import re

from hysteresis_bench.report.shared.text import SUPERSCRIPTS, number, p_equals

CHANCE = re.compile(r"\bp = (\d+(?:\.\d+)?(?:e[+-]?\d+)?)")
POWER = re.compile(r"(?<![\w.-])(-?\d+(?:\.\d+)?)e([+-]\d+)\b")
RAISED = re.compile(r"(?<=[A-Za-z])\^(-?\d+)")
PER_CENT = re.compile(r"(?<=\d) ?%")
AFTER_NUMBER = re.compile(r"(?<=[\d⁰¹²³⁴-⁹] )(um|degC)\b")
UNIT = re.compile(r"\b(um|degC)\b")
PRINTED = {"um": "μm", "degC": "°C"}

SMALL = 0.001
"""A p below it is told as that."""


def in_print(words: str) -> str:
    """2.62e-05 C/m^2 -> 2.62×10⁻⁵ C/m²; 0.3 um -> 0.3 μm; 4.13% -> 4.13 %; p = 2.8e-204 -> p < 0.001."""
    words = CHANCE.sub(lambda found: p_equals(found[1]) if float(found[1]) < SMALL else found[0], words)
    words = POWER.sub(lambda found: number(float(found[0]), sum(map(str.isdigit, found[1]))), words)
    words = AFTER_NUMBER.sub(lambda found: PRINTED[found[1]], _raised(words))
    return PER_CENT.sub("\u202f%", words)


def unit_in_print(unit: str) -> str:
    """C/m^2 -> C/m², um/s -> μm/s."""
    return UNIT.sub(lambda found: PRINTED[found[1]], _raised(unit))


def _raised(words: str) -> str:
    return RAISED.sub(lambda found: found[1].translate(SUPERSCRIPTS), words)


def first_sentence(words: str) -> tuple[str, str]:
    """The first sentence, and the others; empty where there are none."""
    first, stop, others = words.partition(". ")
    return f"{first}{stop.rstrip()}", others
