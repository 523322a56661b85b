"""Time of the Bouc-Wen kernels, as ratios to the one with n = 1 and a shared input in the same run.

python benchmarks/bouc_wen.py
"""

from __future__ import annotations

import numpy as np
from table import Line, fastest, show

SAMPLES, PARTICLES, ROUNDS = 6000, 50, 20
FINE = "bouc-wen, n = 1"


def main() -> None:
    from hysteresis_bench.kernels.bouc_wen import bouc_wen
    from hysteresis_bench.kernels.bouc_wen_power import bouc_wen_power

    rng = np.random.default_rng(0)
    u = np.ascontiguousarray(2.5 * np.sin(np.pi * np.linspace(0.0, 6.0, SAMPLES))[:, None])
    p = rng.uniform(0.0, 2.0, (4, PARTICLES))
    coarse, own = 20.0 * u, np.repeat(u, PARTICLES, axis=1)
    runs = {FINE: lambda: bouc_wen(u, *p), "coarse samples": lambda: bouc_wen(coarse, *p)}
    runs["one input a particle"] = lambda: bouc_wen(own, *p)
    runs |= {f"n = {n:g}": lambda n=n: bouc_wen_power(u, *p, n) for n in (2.0, 3.0, 1.5, 2.7)}
    runs["n = 2, one input a particle"] = lambda: bouc_wen_power(own, *p, 2.0)
    seconds = fastest(runs, ROUNDS)
    asked = {"one input a particle": 1.2, "n = 2": 1.5, "n = 3": 1.5, "n = 1.5": 20.0, "n = 2.7": 20.0}
    cost = 1e9 * seconds[FINE] / (SAMPLES * PARTICLES)
    lines = [Line(name, taken / seconds[FINE], asked.get(name)) for name, taken in seconds.items()]
    show(f"{PARTICLES} x {SAMPLES}; {FINE}: {cost:.2f} ns a particle-sample", f"times {FINE}", lines)


if __name__ == "__main__":
    main()
