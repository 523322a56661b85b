"""Compiled phase kinetics and heat of the shape memory alloy rig, in SI units and degC.

[1] Liang and Rogers, "One-dimensional thermomechanical constitutive relations for shape memory
    materials", J. Intell. Mater. Syst. Struct. 1 (1990) 207-234.
"""

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_plugins.rigs import _sma_mechanics
from hysteresis_plugins.rigs._sma_mechanics import Physics

TOLERANCE = 1e-15  # of a fraction
ITERATIONS = 60

mechanics = njit(cache=True, error_model="numpy")(_sma_mechanics.mechanics)


@njit(cache=True, error_model="numpy")
def left(progress: float) -> float:
    """Share of a phase that is left at this progress through its transformation band; [1]'s cosine law."""
    share: float = 0.5 * (1.0 + np.cos(np.pi * min(max(progress, 0.0), 1.0)))
    return share


@njit(cache=True, error_model="numpy")
def stable_martensite(martensite: float, heat: float, k: Physics) -> float:
    """[1] heating: the share of the martensite at the start that is left, at the stress and temperature
    that belong to this fraction. Never rises with the fraction: latent heat and stress oppose the change."""
    stress, _ = mechanics(martensite, k)
    begin = k.austenite_start + stress / k.austenite_slope
    temperature = heat + k.latent_rise * martensite
    return left((temperature - begin) / (k.austenite_finish - k.austenite_start))


@njit(cache=True, error_model="numpy")
def stable_austenite(martensite: float, heat: float, k: Physics) -> float:
    """[1] cooling: the share of the austenite at the start that is left; never falls with the fraction."""
    stress, _ = mechanics(martensite, k)
    begin = k.martensite_start + stress / k.martensite_slope
    temperature = heat + k.latent_rise * martensite
    return left((begin - temperature) / (k.martensite_start - k.martensite_finish))


@njit(cache=True, error_model="numpy")
def surplus(martensite: float, heating: bool, scale: float, heat: float, k: Physics) -> float:
    """What is too much of the phase that heating (cooling) consumes; above 0 it transforms."""
    if heating:
        return martensite - scale * stable_martensite(martensite, heat, k)
    return 1.0 - martensite - scale * stable_austenite(martensite, heat, k)


@njit(cache=True, error_model="numpy")
def transform(martensite: float, heat: float, martensite_scale: float, austenite_scale: float, k: Physics) -> float:
    """The fraction of martensite that phases, mechanics and latent heat agree on, from the present one.

    heat : wire temperature minus latent_rise times martensite, degC
    martensite_scale, austenite_scale : what the stable shares are multiplied by, so that each curve passes
    through the last reversal

    The consumed phase only shrinks, and its surplus is monotonic: one root, by regula falsi that
    halves the weight of the end it keeps.
    """
    for heating in (True, False):
        scale = martensite_scale if heating else austenite_scale
        above = surplus(martensite, heating, scale, heat, k)
        if above <= 0.0:
            continue
        much, none = martensite, 0.0 if heating else 1.0
        below = surplus(none, heating, scale, heat, k)
        for _ in range(ITERATIONS):
            root = none - below * (much - none) / (above - below)
            rest = surplus(root, heating, scale, heat, k)
            if abs(rest) < TOLERANCE:
                break
            if rest > 0.0:
                much, above, below = root, rest, 0.5 * below
            else:
                none, below, above = root, rest, 0.5 * above
        return root
    return martensite


@njit(cache=True, error_model="numpy")
def rates(
    jacket: float, heat: float, sensor: float, martensite: float, power: float, k: Physics
) -> tuple[float, float, float]:
    """Time derivatives of jacket temperature, heat and sensor temperature, K/s; power in W/m.

    Without wire lag, jacket and wire are one body with the heat of both.
    """
    wire = heat + k.latent_rise * martensite
    if k.wire_lag > 0.0:
        into_wire = (jacket - wire) / k.wire_lag
        supply = power - k.convection * (jacket - k.ambient)
        into_jacket = (supply - k.wire_heat_capacity * into_wire) / k.jacket_heat_capacity
    else:
        jacket = wire
        supply = power - k.convection * (jacket - k.ambient)
        into_wire = supply / (k.jacket_heat_capacity + k.wire_heat_capacity)
        into_jacket = 0.0
    into_sensor = (jacket - sensor) / k.sensor_lag if k.sensor_lag > 0.0 else 0.0
    return into_jacket, into_wire, into_sensor


@njit(cache=True, error_model="numpy")
def simulate(time: Array, voltage: Array, step: float, k: Physics) -> Array:
    """From rest at ambient temperature, all martensite; each voltage holds until the next time.

    time, voltage : float64[samples], s and V
    step : longest integration step, s
    -> float64[6, samples]: jacket, sensor and wire temperature (degC), martensite, stress (Pa), rotation (rad)

    Runge-Kutta of fourth order. Within a step the fraction follows from heat and the step's first fraction.
    """
    out = np.empty((6, time.size))
    state = np.array([k.ambient, k.ambient - k.latent_rise, k.ambient])
    slopes = np.zeros((4, 3))
    martensite, martensite_scale, austenite_scale = 1.0, 1.0, 0.0
    for sample in range(time.size):
        wire = state[1] + k.latent_rise * martensite
        jacket = state[0] if k.wire_lag > 0.0 else wire
        sensor = state[2] if k.sensor_lag > 0.0 else jacket
        stress, rotation = mechanics(martensite, k)
        out[:, sample] = (jacket, sensor, wire, martensite, stress, rotation)
        if sample == time.size - 1:
            break
        duration = time[sample + 1] - time[sample]
        steps = int(np.ceil(duration / step - 1e-9))
        h = duration / steps
        power = voltage[sample] ** 2 / k.resistance
        for _ in range(steps):
            for stage in range(4):
                ahead = h * (0.0, 0.5, 0.5, 1.0)[stage]
                trial = state + ahead * slopes[stage - 1]
                fraction = transform(martensite, trial[1], martensite_scale, austenite_scale, k)
                slopes[stage] = rates(trial[0], trial[1], trial[2], fraction, power, k)
            state += h / 6.0 * (slopes[0] + 2.0 * (slopes[1] + slopes[2]) + slopes[3])
            fraction = transform(martensite, state[1], martensite_scale, austenite_scale, k)
            if fraction < martensite:
                austenite_scale = (1.0 - fraction) / stable_austenite(fraction, state[1], k)
            elif fraction > martensite:
                martensite_scale = fraction / stable_martensite(fraction, state[1], k)
            martensite = fraction
    return out
