"""A mass on a hysteretic spring, one step of integration a sample.

State: started, t, x, v, a, z, stiffness, largest x, the law's state, the law's state in an iteration. Constants: those
of `bouc_wen_generalized`, or zeros; mass, damping, law, length of the law's state; those of another law. What runs away
is not cut: the simulation cuts it by the force of the whole record.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Part
from hysteresis_bench.kernels.bouc_wen_generalized_step import strained
from hysteresis_bench.kernels.bouc_wen_step import moved
from hysteresis_bench.kernels.dahl import slipped
from hysteresis_bench.kernels.oscillator_step import CLOSE, MOST
from hysteresis_bench.kernels.play import played
from hysteresis_plugins.exports.bouc_wen import unbounded
from hysteresis_plugins.models._plays import named, thresholds
from hysteresis_plugins.models.oscillator import LAWS

FIRST = 12
HEAD = 16
STATE = 8


def spring(s: Array, p: Array, old: float, x: float) -> float:
    """The law's step from the displacement before to x; it writes only the state in an iteration."""
    states: int = int(p[FIRST + 3])
    z = 0.0
    if p[FIRST + 2] == 0.0:
        s[STATE + 1] = moved(s[STATE], x - old, p[HEAD] * p[HEAD + 3], p[HEAD + 1], p[HEAD + 2], p[HEAD + 4], np.inf)
        z = p[HEAD + 3] * x - s[STATE + 1]
    elif p[FIRST + 2] == 1.0:
        s[STATE + 2], s[STATE + 3] = strained(s[STATE], s[STATE + 1], x - old, p)
        z = p[10] * x + p[11] * s[STATE + 2]
    elif p[FIRST + 2] == 2.0:
        s[STATE + 2], s[STATE + 3] = slipped(s[STATE], s[STATE + 1], x - old, p[HEAD], p[HEAD + 1], p[HEAD + 2])
        z = p[HEAD + 3] * x + p[HEAD + 4] * s[STATE + 2]
    elif p[FIRST + 2] == 3.0:
        powers: int = int(p[HEAD])
        for k in range(states):
            place = played(x, p[HEAD + 1 + k], s[STATE + k])
            s[STATE + states + k] = place
            value = 0.0
            for m in range(powers):
                value = place * (p[HEAD + states + (k + 1) * powers - m] + value)
            z += value
    else:
        z = p[HEAD] * x
        for k in range(states):
            place = played(x, p[HEAD + 2 + k] + p[HEAD + 1], s[STATE + k])
            s[STATE + states + k] = place
            e = x - place
            z += p[HEAD + 2 + states + k] * (max(e - p[HEAD + 1], 0.0) + min(e + p[HEAD + 1], 0.0))
    return z


def law(s: Array, p: Array, t: float, u: float) -> float:
    states: int = int(p[FIRST + 3])
    mass = p[FIRST]
    damping = p[FIRST + 1]
    if s[0] == 0.0:
        s[0] = 1.0
        s[4] = u / mass
        s[5] = spring(s, p, 0.0, 0.0)
    else:
        width = t - s[1]
        inertia = 4.0 * mass / (width * width) + 2.0 * damping / width
        pull = mass * (4.0 * s[3] / width + s[4]) + damping * s[3] + u
        old = s[2]
        way = change = (pull - s[5]) / (inertia + max(s[6], 0.0))
        before = s[5]
        for _ in range(MOST):
            z = spring(s, p, old, old + change)
            if way != 0.0:
                s[6] = (z - before) / way
            way = (pull - z - inertia * change) / (inertia + max(s[6], 0.0))
            change += way
            before = z
            if abs(way) <= CLOSE * s[7]:
                break
        s[2] = old + change
        s[5] = before + s[6] * way
        faster = 2.0 * (s[2] - old) / width - s[3]
        s[4] = 2.0 * (faster - s[3]) / width - s[4]
        s[3] = faster
        for k in range(states):
            s[STATE + k] = s[STATE + states + k]
        s[7] = max(s[7], abs(s[2]))
    s[1] = t
    return s[2]


def part(model: Any, p: Mapping[str, float], timed: bool) -> Part:
    """Raises ValueError where the steps between samples need the force to come, and where h has no bound."""
    if model.substeps != 1:
        raise ValueError(
            "its force between samples is a spline through the whole record, samples to come included; "
            "fitted with --set substeps=1 it can be"
        )
    spring_law = LAWS[model.law]
    own = [p[parameter.name] for parameter in spring_law.parameters]
    head, first, states = [0.0] * FIRST, list[float](), 2
    if model.law == "bouc-wen":
        if reason := unbounded(p):
            raise ValueError(reason)
        first, states = [p["alpha"], p["beta"], p["gamma"], p["d"], float(spring_law.n)], 1
    elif model.law == "bouc-wen-generalized":
        head = own
    elif model.law == "dahl":
        first = own
    elif model.law == "maxwell-slip":
        states = spring_law.elements
        limits = spring_law.limits(np.array([p["radius"]]))[:, 0]
        first = [p["slope"], p["gap"], *map(float, limits), *(p[name] for name in named("k", states))]
    else:
        states = spring_law.plays + 1
        radii = thresholds(np.array([p["radius"]]), spring_law.plays)[:, 0]
        first = [float(len(own[1:]) // states), *map(float, radii), *own[1:]]
    kinds = {"bouc-wen": 0.0, "bouc-wen-generalized": 1.0, "dahl": 2.0, "maxwell-slip": 4.0}
    about = (p["mass"], p["damping"], kinds.get(model.law, 3.0), float(states))
    return Part((*head, *about, *first), state=STATE + 2 * states)
