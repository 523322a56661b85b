"""Time of the Bouc-Wen and second-order kernels, in ns a particle-sample on one core."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np


def rows(samples: int = 6000, particles: int = 50, repeats: int = 30) -> list[tuple[str, float, float | None]]:
    """(kernel, ns a particle-sample including the writing of its output, target), the fastest of the repeats."""
    from hysteresis_bench.kernels.bouc_wen import bouc_wen
    from hysteresis_bench.kernels.bouc_wen_power import bouc_wen_power
    from hysteresis_bench.kernels.second_order import second_order

    rng = np.random.default_rng(0)
    grid = np.linspace(0.0, 6.0, samples)
    u = np.ascontiguousarray(2.5 * np.sin(np.pi * grid)[:, None])
    coarse = 20.0 * u
    own = np.repeat(u, particles, axis=1)
    p = rng.uniform(0.0, 2.0, (4, particles))
    damping, stiffness = np.full(particles, 510.1), np.full(particles, 255_700.0)

    def timed(name: str, run: Callable[[], object], target: float | None = None) -> tuple[str, float, float | None]:
        run()
        best = np.inf
        for _ in range(repeats):
            before = time.thread_time()
            run()
            best = min(best, time.thread_time() - before)
        return name, 1e9 * best / (samples * particles), target

    return [
        timed("bouc-wen", lambda: bouc_wen(u, *p), 1.5),
        timed("bouc-wen, coarse samples", lambda: bouc_wen(coarse, *p)),
        timed("bouc-wen, one input a particle", lambda: bouc_wen(own, *p)),
        *(timed(f"bouc-wen, n = {n:g}", lambda n=n: bouc_wen_power(u, *p, n)) for n in (1.5, 2.0, 2.7, 3.0)),
        timed("bouc-wen, n = 2, one input a particle", lambda: bouc_wen_power(own, *p, 2.0)),
        timed("second-order", lambda: second_order(grid, u, damping, stiffness)),
    ]


if __name__ == "__main__":
    for name, cost, target in rows():
        print(f"{name:32s} {cost:8.2f} ns" + (f"   target {target} ns" if target else ""))
