"""A magnetostrictive rod, one sample on; state: that of `free_energy`, then of the second-order stage.

Constants: those of `free_energy`, turns, bias field, strain over the square of the magnetization, deflection over
strain, deflection at rest, damping, stiffness, timed.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_plugins.exports import free_energy
from hysteresis_plugins.exports.free_energy import law as magnetized
from hysteresis_plugins.exports.resonance import STATE, staged


def law(s: Array, p: Array, t: float, u: float) -> float:
    nodes: int = int(p[3])
    o: int = 4 + 2 * nodes
    m = magnetized(s, p, t, p[o] * u + p[o + 1])
    deflection = p[o + 3] * (p[o + 2] * m * m) + p[o + 4]
    return 1e6 * (staged(s, nodes, p[o + 5], p[o + 6], t, deflection) if p[o + 7] != 0.0 else deflection)


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    """Raises ValueError where the bias may come from a column."""
    if model.bias_field is None:
        raise ValueError("its bias field may be a column of the data, which a step is not given; fit with bias_field")
    first = free_energy.part(model._magnetization, p, timed)
    rest = (model.mass * model.disturbance - model.prestress * model.area) / model.stiffness
    strained, pushed = 1.5 * p["lambda_s"] / p["M_s"] ** 2, model.area * model.modulus / model.stiffness
    stage = model.damping / model.mass, model.stiffness / model.mass, float(timed)
    constants = (*first.constants, model.turns, model.bias_field, strained, pushed, rest, *stage)
    return Part(constants, state=first.state + STATE)
