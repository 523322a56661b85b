"""Compiled physics of the piezoelectric rig: amplifier, hysteresis, creep, mechanics. Voltages V, displacements um.

The state is one array: voltage at the ceramic, deviation of the stage from its static position, its velocity,
the displacement of the ceramic without and with creep, then the play operators, then the creep elements.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.second_order import transition

VOLTAGE, DEVIATION, VELOCITY, PROMPT, CREPT, PLAYS = range(6)


class Physics(NamedTuple):
    """Constants of the rig."""

    amplifier_lag: float  # s
    instantaneous: float  # um/V, what follows the voltage without memory
    weight: float  # um/V, of every play operator
    radii: Array  # V, half widths of the play operators
    saturation: float  # um, infinite where off
    asymmetry: float  # 1/um
    creep: float  # of every creep element, 1
    creep_times: Array  # s
    damping: float  # 1/s
    stiffness: float  # 1/s^2, infinite where the stage is rigid
    step: float  # s, longest internal step


def rest(k: Physics) -> Array:
    """The depolarised ceramic at 0 V, at rest."""
    return np.zeros(PLAYS + k.radii.size + k.creep_times.size)


@njit(cache=True, error_model="numpy")
def _ceramic(state: Array, voltage: float, k: Physics) -> float:
    """Move the play operators to this voltage -> prompt displacement of the ceramic, um."""
    polarised = k.instantaneous * voltage
    for i in range(k.radii.size):
        play = min(max(state[PLAYS + i], voltage - k.radii[i]), voltage + k.radii[i])
        state[PLAYS + i] = play
        polarised += k.weight * play
    share = polarised / k.saturation
    return polarised * (1.0 + k.asymmetry * polarised) / math.sqrt(1.0 + share * share)


@njit(cache=True, error_model="numpy")
def advance(state: Array, first: float, last: float, duration: float, k: Physics) -> Array:
    """The state after the command has gone linearly from first to last within the duration; a new array.

    state : float64[...], see the module;  first, last : V;  duration : s
    """
    state = state.copy()
    parts = max(1, math.ceil(duration / k.step - 1e-9))
    step = duration / parts
    rise = (last - first) / duration
    kept = math.exp(-step / k.amplifier_lag) if k.amplifier_lag > 0.0 else 0.0
    phi00, phi01, phi10, phi11, lag = transition(k.damping, k.stiffness, step)
    creeping = PLAYS + k.radii.size
    for part in range(parts):
        # every stage exactly, for an input that is linear within the internal step
        command = first + rise * step * part
        trailing = state[VOLTAGE] - command + k.amplifier_lag * rise
        state[VOLTAGE] = command + rise * (step - k.amplifier_lag) + trailing * kept
        prompt = _ceramic(state, state[VOLTAGE], k)
        slope = (prompt - state[PROMPT]) / step
        crept = prompt
        for i in range(k.creep_times.size):
            time = k.creep_times[i]
            behind = state[creeping + i] - state[PROMPT] + time * slope
            state[creeping + i] = prompt - time * slope + behind * math.exp(-step / time)
            crept += k.creep * state[creeping + i]
        slope = (crept - state[CREPT]) / step
        deviation, velocity = state[DEVIATION], state[VELOCITY]
        state[DEVIATION] = phi00 * deviation + phi01 * velocity - lag * slope
        state[VELOCITY] = phi10 * deviation + phi11 * velocity + (1.0 - phi00) * slope
        state[PROMPT], state[CREPT] = prompt, crept
    return state


@njit(cache=True, error_model="numpy")
def simulate(state: Array, time: Array, voltage: Array, k: Physics) -> Array:
    """Displacement at every sample, um; time : float64[samples] s, voltage : float64[samples] V, linear between.

    The first sample's voltage is applied long before: all but hysteresis and creep have settled on it.
    """
    displacement = np.empty(time.size)
    state = state.copy()
    state[VOLTAGE] = voltage[0]
    state[PROMPT] = _ceramic(state, voltage[0], k)
    state[CREPT] = state[PROMPT]
    displacement[0] = state[CREPT]
    for i in range(1, time.size):
        state = advance(state, voltage[i - 1], voltage[i], time[i] - time[i - 1], k)
        displacement[i] = state[CREPT] + state[DEVIATION]
    return displacement
