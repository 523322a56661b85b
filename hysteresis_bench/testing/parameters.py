"""What the parameters of a model or of an effect promise: names, units, meanings, sound boxes."""

from __future__ import annotations

import keyword
from collections.abc import Sequence

from hysteresis_bench.parameters import Parameter
from hysteresis_bench.testing.contract import expect
from hysteresis_bench.testing.examples import QUANTITIES

MARGIN = 0.01
"""Share of a logarithmic box by which a null of 0 may lie below it."""


def expect_described(parameters: Sequence[Parameter]) -> None:
    """Raises Broken unless every parameter has a name that Python takes, a unit that can be filled in, a meaning."""
    faults = []
    names = [parameter.name for parameter in parameters]
    for parameter in parameters:
        name = parameter.name
        if not name.isidentifier() or name.startswith("_") or keyword.iskeyword(name):
            faults.append(f"{name!r} is no name for a parameter: letters, digits and _, as p.{'name'} finds it.")
        if names.count(name) > 1:
            faults.append(f"two parameters are both named {name!r}.")
        if not parameter.meaning:
            faults.append(f"{name} has no meaning: say in a few words what it is, for tables and reports.")
        try:
            unit = parameter.unit_in(QUANTITIES)
        except (KeyError, IndexError, ValueError):
            faults.append(f"{name}: the unit {parameter.unit!r} may name {{input}}, {{output}} and {{time}} only.")
        else:
            if not unit.strip():
                faults.append(f'{name} has no unit; a number without one has the unit "1".')
    expect(not faults, " ".join(dict.fromkeys(faults)))


def expect_sound(box: Sequence[Parameter], parameters: Sequence[Parameter], what: str) -> None:
    """Raises Broken unless a box has these parameters, room in each, and every null in it or at its lower edge."""
    names, wanted = ([one.name for one in some] for some in (box, parameters))
    expect(names == wanted, f"{what} has the parameters {names}, not {wanted}.")
    faults = [fault for parameter in box for fault in parameter.faults()]
    for one in box:
        if one.null is not None and not faults:
            margin = MARGIN * (one.upper - one.lower) if one.scaling == "log" else 0.0
            if not one.lower - margin <= one.null <= one.upper:
                faults.append(f"{one.name}: the null {one.null:g} lies outside {one.lower:g} to {one.upper:g}.")
    expect(not faults, f"{what}: {' '.join(faults)}")
