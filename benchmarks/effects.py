"""Time of the effects' kernels, as ratios to the Bouc-Wen kernel alone in the same run.

python benchmarks/effects.py
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from table import Line, fastest, show

SAMPLES, PARTICLES, ROUNDS = 6000, 50, 60


def kernels() -> tuple[float, list[Line]]:
    """B in ns a particle-sample, and of every kernel its time over it, the fastest of interleaved rounds.

    B : of `bouc_wen` with a shared input

    The kernels in place are repeated on one array, parameters drawn so that it neither grows nor vanishes.
    """
    from hysteresis_bench.kernels.bouc_wen import bouc_wen
    from hysteresis_bench.kernels.delay import delay
    from hysteresis_bench.kernels.effects.asymmetry import bend
    from hysteresis_bench.kernels.effects.curve_in_time import add, products, scale_and_add
    from hysteresis_bench.kernels.effects.fatigue import fade
    from hysteresis_bench.kernels.effects.saturation import saturate
    from hysteresis_bench.kernels.lag import lag, late_response
    from hysteresis_bench.kernels.play import play
    from hysteresis_bench.kernels.resources import economical
    from hysteresis_bench.kernels.second_order import second_order
    from hysteresis_bench.kernels.sinusoid import add_sinusoid

    rng = np.random.default_rng(0)
    grid = np.linspace(0.0, 6.0, SAMPLES)
    uneven = grid + np.random.default_rng(1).uniform(-4e-4, 4e-4, SAMPLES)
    u = np.ascontiguousarray(2.5 * np.sin(np.pi * grid)[:, None])
    p = rng.uniform(0.0, 2.0, (4, PARTICLES))
    one, small = np.ones(PARTICLES), rng.normal(0.0, 1e-9, PARTICLES)
    y = bouc_wen(u, *p)
    own = np.repeat(u, PARTICLES, axis=1)
    constants = rng.uniform(1e-3, 0.3, (5, PARTICLES))
    level, sharpness = rng.uniform(0.0, 0.4, PARTICLES), rng.uniform(1.0, 20.0, PARTICLES)
    runs: list[tuple[str, Callable[[], object], float]] = [
        ("bouc-wen", lambda: bouc_wen(u, *p), 1.0),
        ("bouc-wen, an input each", lambda: bouc_wen(own, *p), 1.2),
        ("asymmetry", lambda: bend(u, small), 0.4),
        ("backlash", lambda: play(u, constants[0]), 2.0),
        ("lag of the input", lambda: lag(grid, u, constants[0]), 2.0),
        ("lag of the output", lambda: lag(grid, y, constants[0]), 2.0),
        ("delay", lambda: delay(grid, y, constants[0]), 2.0),
        ("delay, uneven steps", lambda: delay(uneven, y, constants[0]), 2.0),
        ("resonance", lambda: second_order(grid, y, 100.0 * one, 1e5 * one), 2.0),
        ("creep, five relaxations", lambda: late_response(grid, y, 0.3 * one, constants), 2.0),
        ("saturation", lambda: saturate(y, level, sharpness), 5.0),
        ("fatigue", lambda: fade(y, u, np.abs(small)), 2.0),
        ("temperature", lambda: scale_and_add(y, grid, small, small), 2.0),
        ("drift", lambda: add(y, grid, small), 0.4),
        ("record offset or drift, estimate", lambda: products(y, grid), 2.0),
        ("periodic disturbance", lambda: add_sinusoid(y, grid, small, small, 5.0 * one), 2.0),
    ]
    columns: dict[str, int] = {}
    for plays in (20, 100):  # K plays are a swarm of radii on one input
        radii = np.linspace(0.0, 2.0, plays)
        runs.append((f"play bank of {plays}, a play", lambda radii=radii: play(u, radii), 0.2))
        columns[runs[-1][0]] = plays
    with economical():
        seconds = fastest({name: run for name, run, _ in runs}, ROUNDS)
    particle = seconds["bouc-wen"] / PARTICLES
    lines = [Line(name, seconds[name] / columns.get(name, PARTICLES) / particle, asked) for name, _, asked in runs]
    return 1e9 * particle / SAMPLES, lines


CHAIN = ("input-lag", "creep", "saturation", "drift")


def systems() -> list[Line]:
    """Of a model with effects around it, its time over that of the bare one."""
    from hysteresis_bench import registry
    from hysteresis_bench.compose import System
    from hysteresis_bench.kernels.resources import economical
    from hysteresis_bench.signals import Record

    grid = np.linspace(0.0, 6.0, SAMPLES)
    drive = 2.5 * np.sin(np.pi * grid)
    record = Record(grid, drive, drive, columns={"temperature": 20.0 + grid})
    model = registry.build("models", "bouc-wen")
    rng = np.random.default_rng(0)
    shipped = [name for name in registry.names("effects") if name != registry.DESCRIPTION]
    asked = {(): 1.0, **{(name,): 4.0 for name in shipped}}
    asked |= {CHAIN: 8.0, tuple(name for name in CHAIN if name != "saturation"): 2.5}
    runs: dict[tuple[str, ...], Callable[[], object]] = {}
    for names in asked:
        system = System(model, registry.build_effects(model, names))
        box = system.box((record,))
        share = rng.uniform(0.05, 0.95, (len(box), PARTICLES))
        values = np.array([[p.lower] for p in box]) + share * np.array([[p.upper - p.lower] for p in box])
        runs[names] = lambda system=system, values=values: system.respond(record, values)
    with economical():
        seconds = fastest({" + ".join(names): run for names, run in runs.items()}, ROUNDS // 3)
    return [
        Line(name or "bouc-wen alone", taken / seconds[""], most)
        for (name, taken), most in zip(seconds.items(), asked.values(), strict=True)
    ]


LAWS = ("bouc-wen", "jiles-atherton", "free-energy")
SWARMS = 4


def inside() -> list[Line]:
    """Of a law with eddy currents inside, its time over that without, for swarms drawn from the box: mean and worst."""
    from hysteresis_bench import registry
    from hysteresis_bench.compose import System
    from hysteresis_bench.kernels.resources import economical
    from hysteresis_bench.parameters import Space
    from hysteresis_bench.signals import Record

    grid = np.linspace(0.0, 6.0, SAMPLES)
    drive = 2.5 * np.sin(np.pi * grid) + np.sin(3.5 * np.pi * grid)
    record = Record(grid, drive, np.tanh(drive))
    runs: dict[str, Callable[[], object]] = {}
    for law in LAWS:
        model = registry.build("models", law)
        for swarm in range(SWARMS):
            for effects in ((), ("eddy-current",)):
                system = System(model, registry.build_effects(model, effects))
                space = Space(system.box((record,)))
                values = space.from_unit(np.random.default_rng(swarm).random((space.dimension, PARTICLES)))
                runs[f"{law} {swarm} {bool(effects)}"] = lambda system=system, values=values: system.respond(
                    record, values
                )
    with economical():
        seconds = fastest(runs, 3)
    lines = []
    for law in LAWS:
        times = [seconds[f"{law} {swarm} True"] / seconds[f"{law} {swarm} False"] for swarm in range(SWARMS)]
        lines += [Line(law, float(np.mean(times)), 10.0), Line(f"{law}, the worst of {SWARMS} swarms", max(times))]
    return lines


if __name__ == "__main__":
    base, lines = kernels()
    told = f"B = {base:.2g} ns a particle-sample, bouc-wen with a shared input"
    show(f"Kernels, {PARTICLES} particles, {SAMPLES} samples; {told}", "B", lines)
    show("Bouc-Wen with effects around it, against the bare one", "times", systems())
    show("Laws with eddy currents inside, against themselves without", "times", inside())
