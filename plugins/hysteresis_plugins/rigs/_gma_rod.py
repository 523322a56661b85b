"""A magnetostrictive rod in a coil: Preisach magnetization in shells, between which the field diffuses."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array

PERMEABILITY = 4e-7 * math.pi


class Material(NamedTuple):
    """M(H) = M_s (1 - r) sum_j v_j tanh(P_j / b_j) + M_s r H / sqrt(a^2 + H^2), P_j plays of H.

    coercive, width, share : (nodes,) H_c and b in A/m, and the share v of the relays, by class of H_c
    saturation : M_s, A/m;  reversible : r;  softness : a, A/m
    """

    coercive: Array
    width: Array
    share: Array
    saturation: float
    reversible: float
    softness: float


@njit(cache=True, error_model="numpy")
def _magnetized(h: float, state: Array, material: Material) -> tuple[float, float]:
    """Magnetization and its slope at the field h, with memory `state`, which is left as it is."""
    total = 0.0
    slope = 0.0
    for j in range(state.size):
        high, low = h + material.coercive[j], h - material.coercive[j]
        p = min(high, max(low, state[j]))
        upper = math.tanh(p / material.width[j])
        total += material.share[j] * upper
        if p != state[j]:
            slope += material.share[j] * (1.0 - upper * upper) / material.width[j]
    root = math.sqrt(material.softness**2 + h * h)
    irreversible = material.saturation * (1.0 - material.reversible)
    reversible = material.saturation * material.reversible
    magnetization = irreversible * total + reversible * h / root
    return magnetization, irreversible * slope + reversible * material.softness**2 / root**3


@njit(cache=True, error_model="numpy")
def _remember(h: float, state: Array, coercive: Array) -> None:
    for j in range(state.size):
        state[j] = min(h + coercive[j], max(h - coercive[j], state[j]))


@njit(cache=True, error_model="numpy")
def uniform(surface: Array, material: Material) -> tuple[Array, Array]:
    """A rod without eddy currents: field and magnetization, float64[samples, 1] in A/m. As `diffused`."""
    field, magnetization = np.empty((surface.size, 1)), np.empty((surface.size, 1))
    state = np.zeros(material.coercive.size)
    for k in range(surface.size):
        field[k, 0] = surface[k]
        magnetization[k, 0] = _magnetized(surface[k], state, material)[0]
        _remember(surface[k], state, material.coercive)
    return field, magnetization


@njit(cache=True, error_model="numpy")
def diffused(
    surface: Array, step: float, radius: float, shells: int, resistivity: float, material: Material
) -> tuple[Array, Array]:
    """Axial field in a long conducting rod: dB/dt = resistivity (1/r) d/dr (r dH/dr), B = mu_0 (H + M(H)).

    Finite volumes of equal thickness, backward Euler, Newton on the tridiagonal system of every step.
    Demagnetized at first, then at rest in the first field.

    surface : float64[samples]   field of the coil, A/m, a sample every `step` s
    radius : m;  resistivity : Ohm m
    -> float64[samples, shells] twice: field and magnetization, A/m, innermost shell first
    """
    samples, nodes = surface.size, material.coercive.size
    width = radius / shells
    field, magnetization = np.empty((samples, shells)), np.empty((samples, shells))
    state = np.zeros((shells, nodes))
    flux = np.empty(shells)
    h = np.full(shells, surface[0])
    for i in range(shells):
        field[0, i] = h[i]
        magnetization[0, i] = _magnetized(h[i], state[i], material)[0]
        _remember(h[i], state[i], material.coercive)
        flux[i] = PERMEABILITY * (h[i] + magnetization[0, i])
    # conductance of the faces, per volume of the shell: r_face / (r_centre width^2), at the surface twice that
    factor = step * resistivity / width**2
    outward, inward = np.empty(shells), np.empty(shells)
    for i in range(shells):
        outward[i] = factor * (i + 1.0) / (i + 0.5) * (2.0 if i == shells - 1 else 1.0)
        inward[i] = factor * i / (i + 0.5)
    residual, diagonal, change = np.empty(shells), np.empty(shells), np.empty(shells)
    for k in range(1, samples):
        scale = PERMEABILITY * (1.0 + np.max(np.abs(h)) + abs(surface[k]))
        for _ in range(50):
            for i in range(shells):
                magnetization[k, i], slope = _magnetized(h[i], state[i], material)
                above = h[i + 1] if i < shells - 1 else surface[k]
                below = h[i - 1] if i > 0 else 0.0
                residual[i] = (
                    PERMEABILITY * (h[i] + magnetization[k, i])
                    - flux[i]
                    - outward[i] * (above - h[i])
                    - inward[i] * (below - h[i])
                )
                diagonal[i] = PERMEABILITY * (1.0 + slope) + outward[i] + inward[i]
            if np.max(np.abs(residual)) < 1e-10 * scale:
                break
            for i in range(1, shells):  # Thomas elimination; off-diagonals are -inward and -outward
                ratio = inward[i] / diagonal[i - 1]
                diagonal[i] -= ratio * outward[i - 1]
                residual[i] += ratio * residual[i - 1]
            change[shells - 1] = residual[shells - 1] / diagonal[shells - 1]
            for i in range(shells - 2, -1, -1):
                change[i] = (residual[i] + outward[i] * change[i + 1]) / diagonal[i]
            h -= change
        for i in range(shells):
            field[k, i] = h[i]
            _remember(h[i], state[i], material.coercive)
            flux[i] = PERMEABILITY * (h[i] + magnetization[k, i])
    return field, magnetization
