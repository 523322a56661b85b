"""What a parameter's unit says of input, output and time."""

from __future__ import annotations

import re
from collections.abc import Mapping

from hysteresis_bench.parameters import Parameter
from hysteresis_bench.testing.examples import QUANTITIES

SYMBOLS = {"I": "input", "O": "output", "T": "time", "s": "time"}


def exponents(unit: str) -> dict[str, int]:
    """Powers of input, output and time in a unit such as "{output}/{input}^2"."""
    numerator, _, denominator = unit.format(input="I", output="O", time="T").partition("/")
    powers = dict.fromkeys(QUANTITIES, 0)
    for part, sign in ((numerator, 1), (denominator, -1)):
        for symbol, quantity in SYMBOLS.items():
            powers[quantity] += sign * sum(int(power or 1) for power in re.findall(rf"\b{symbol}\b(?:\^(\d))?", part))
    return powers


def factor(parameter: Parameter, scales: Mapping[str, float]) -> float:
    """By how much a parameter's value grows where input, output and time grow by these factors."""
    product = 1.0
    for quantity, power in exponents(parameter.unit).items():
        product *= scales[quantity] ** power
    return product
