"""How fast the free-energy kernel is, and how much faster than relays of the same accuracy.

python benchmarks/free_energy.py
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import numpy as np
from numba import njit

from hysteresis_bench.arrays import Array
from hysteresis_bench.kernels.free_energy import magnetization, quadrature

SAMPLES, SWARM = 2000, 48
COERCIVE, SPREAD, INTERACTION = 1.0, 0.25, 0.6


@njit(error_model="numpy", fastmath={"contract", "reassoc"})
def relays(field: Array, coercive: Array, density: Array, interaction: Array, weight: Array) -> Array:
    """Equations (1) to (3) relay by relay, the inner loop vectorised: (samples,)."""
    rows, columns = coercive.size, interaction.size
    signed = np.empty((rows, columns))
    for i in range(rows):
        for j in range(columns):
            signed[i, j] = weight[j] if interaction[j] > 0.0 else -weight[j]
    magnetized = np.empty(field.size)
    for k in range(field.size):
        total = 0.0
        for i in range(rows):
            up, down = coercive[i] - field[k], -coercive[i] - field[k]
            row = 0.0
            for j in range(columns):
                value = weight[j] if interaction[j] >= up else signed[i, j]
                value = -weight[j] if interaction[j] <= down else value
                signed[i, j] = value
                row += value
            total += density[i] * row
        magnetized[k] = total
    return magnetized


def grid(rows: int, columns: int) -> tuple[Array, Array, Array, Array]:
    """H_c and its density, H_I and its density, each normalised to 1."""
    offsets = np.linspace(-3.5, 3.5, rows)
    density = np.exp(-(offsets**2))
    interaction = ((np.arange(columns) + 0.5) / columns - 0.5) * 10.0 * INTERACTION
    weight = np.exp(-(interaction**2) / (2 * INTERACTION**2))
    coercive = COERCIVE * np.exp(2 * SPREAD * (SPREAD + offsets))
    return coercive, density / density.sum(), interaction, weight / weight.sum()


def seconds(run: Callable[[], Array], repeats: int) -> float:
    """CPU time of the fastest of some runs, after one that compiles."""
    run()
    fastest = np.inf
    for _ in range(repeats):
        began = time.process_time()
        run()
        fastest = min(fastest, time.process_time() - began)
    return fastest


def rows(repeats: int = 7) -> Iterator[dict[str, object]]:
    """One row a kernel: kernel, ns a particle-sample, and the relative RMS error against 4001 nodes."""
    phase = np.linspace(0.0, 1.0, SAMPLES)
    field = 4.0 * np.sin(16 * np.pi * phase) * (1.0 - 0.7 * phase)
    spread = np.exp(np.random.default_rng(0).normal(0.0, 0.3, (3, SWARM)))
    swarm = np.array([[COERCIVE], [SPREAD], [INTERACTION]]) * spread
    swarm[:, 0] = COERCIVE, SPREAD, INTERACTION
    zero, one = np.zeros(SWARM), np.ones(SWARM)

    def played(nodes: int, span: float = 3.0) -> Array:
        return magnetization(field[:, None], zero, one, *swarm, *quadrature("trapezoid", nodes, span))

    exact = played(4001, 5.0)
    extent = np.ptp(exact, axis=0)
    for nodes in (16, 32, 64, 128):
        error = float(np.sqrt(np.mean(((played(nodes) - exact) / extent) ** 2)))
        elapsed = seconds(lambda n=nodes: played(n), repeats)
        yield {"kernel": f"free-energy, {nodes} nodes", "ns": 1e9 * elapsed / (SAMPLES * SWARM), "error": error}
    for size in (40, 80, 160):
        axes = grid(size, 2 * size)
        error = float(np.sqrt(np.mean((relays(field, *axes) - exact[:, 0]) ** 2)) / extent[0])
        elapsed = seconds(lambda a=axes: relays(field, *a), min(repeats, 3))
        yield {"kernel": f"relays, {size} x {2 * size}", "ns": 1e9 * elapsed / SAMPLES, "error": error}


if __name__ == "__main__":
    measured = list(rows())
    for row in measured:
        print(f"{row['kernel']:28s}{row['ns']:12.1f} ns a particle-sample    relative error {row['error']:.1e}")
    for relay in measured[4:]:
        as_good = next((row for row in measured[:4] if row["error"] <= relay["error"]), None)
        if as_good:
            print(f"{as_good['kernel']} is {relay['ns'] / as_good['ns']:.0f} times faster than {relay['kernel']}")
