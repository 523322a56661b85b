"""The Bouc-Wen benchmark of Noël and Schoukens: which class of law, which spring, and how well are unseen forces met?

    python benchmarks/noel_schoukens.py

Looks for the data as laws.py does. The record has five equal periods of a multisine; the last one is held out. No
constant of the benchmark is used in the fit: the class is settled by `compare` on the first period, the spring by the
second, and the winner is fitted to the first four. Then it meets forces of its own making: a multisine of other
phases and a sweep, without noise, by an integrator of high order with the benchmark's published constants [1].

[1] J. P. Noël, M. Schoukens, Hysteretic benchmark with a dynamic nonlinearity, Workshop on Nonlinear System
    Identification Benchmarks, Brussels (2016). Best published black box on its own multisine: 1.87e-5 m (A. Fakhrizadeh
    Esfahani et al., 2017).
"""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
from real_measurements import DATA
from scipy.integrate import solve_ivp
from table import Line, show

from hysteresis_bench import FitOptions, compare, fit, load
from hysteresis_bench.arrays import Array
from hysteresis_bench.fit.fitting import Fit
from hysteresis_bench.signals import Dataset, Record
from hysteresis_plugins.models.oscillator import LAWS

PERIOD, RATE = 8192, 750.0
BUDGET = 1500
"""Evaluations of each of a fit's two searches."""
CLASSES = ("oscillator", "hammerstein", "bouc-wen", "preisach", "prandtl-ishlinskii")
MASS, DAMPING, STIFFNESS, ALPHA, BETA, GAMMA, DELTA = 2.0, 10.0, 5e4, 5e4, 1e3, 0.8, -1.1
NOISE = 7.4e-6
"""m RMS, from the difference of the record's periods."""


def main() -> None:
    record = load(DATA / "boucwen-benchmark" / "train_multisine.csv").records[0]
    first = record.take(slice(0, PERIOD))
    table = compare(Dataset((first,)), CLASSES).table.sort_values("unseen")
    for law, error in zip(table["law"], table["unseen"], strict=True):
        print(f"{law:28s} {error:.3g} m left out", flush=True)
    then = replace(record.take(slice(0, 2 * PERIOD)), history=PERIOD)
    springs: dict[str, Fit] = {}
    for law in LAWS:
        begun = time.process_time()
        springs[law] = _fitted(first, law)
        print(
            f"a spring of {law:26s} {_error(springs[law], then):.3g} m, {time.process_time() - begun:.0f} s", flush=True
        )
    spring = min(springs, key=lambda law: _error(springs[law], then))
    begun = time.process_time()
    found = _fitted(record.take(slice(0, 4 * PERIOD)), spring)
    for name, estimate in found.model.parameters.items():
        print(f"{name:10s} {estimate.value:.6g} ± {estimate.standard_error or np.nan:.2g}")
    rng = np.random.default_rng(20160425)
    forces = {"multisine": multisine(rng), "sweep": sweep()}
    unseen = {name: replace(_answered(*force), units=record.units) for name, force in forces.items()}
    lines = [
        Line("class found: oscillator (1: yes)", float(table["law"].iloc[0] == "oscillator"), least=1.0),
        Line(f"held-out period over the noise, spring {spring}", _error(found, _last(record)) / NOISE, most=1.15),
        *(Line(f"{name} without noise, 1e-5 m", 1e5 * _error(found, one), most=2.0) for name, one in unseen.items()),
        *(Line(f"its RMS, 1e-5 m ({name})", 1e5 * float(np.std(one.measured))) for name, one in unseen.items()),
        Line("CPU seconds of the last fit", time.process_time() - begun),
    ]
    show("Bouc-Wen benchmark: RMSE of the displacement", "", lines)


def _fitted(record: Record, law: str) -> Fit:
    return fit(Dataset((record,)), "oscillator", settings={"law": law}, options=FitOptions(budget=BUDGET))


def _last(record: Record) -> Record:
    return replace(record, history=4 * PERIOD)


def _error(found: Fit, record: Record) -> float:
    predicted = found.model.predict(Dataset((record,))).records[0]
    return float(np.sqrt(np.mean((predicted.measured - record.measured) ** 2)))


def multisine(rng: np.random.Generator) -> tuple[Array, Array]:
    """All lines of a period from 5 to 150 Hz, RMS 50 N: time and force of two periods at the record's rate, 20 fine
    samples each."""
    lines = np.arange(int(5.0 * PERIOD / RATE) + 1, int(150.0 * PERIOD / RATE))
    phases = rng.uniform(0.0, 2.0 * np.pi, lines.size)
    fine = np.arange(2 * PERIOD * 20) / (20.0 * RATE)
    force = np.zeros_like(fine)
    for line, phase in zip(lines, phases, strict=True):
        force += np.cos(2.0 * np.pi * line * RATE / PERIOD * fine + phase)
    return fine, 50.0 * force / np.std(force)


def sweep() -> tuple[Array, Array]:
    """20 to 50 Hz in two periods' time, 40 N."""
    fine = np.arange(2 * PERIOD * 20) / (20.0 * RATE)
    rate = 30.0 / fine[-1]
    return fine, 40.0 * np.sin(2.0 * np.pi * (20.0 * fine + 0.5 * rate * fine**2))


def _answered(fine: Array, force: Array) -> Record:
    """By the benchmark's equations, with DOP853 to 1e-8 of the state or 1e-10 m; every twentieth sample."""

    def slope(t: float, state: Array) -> list[float]:
        x, v, z = state
        u = np.interp(t, fine, force)
        return [
            v,
            (u - DAMPING * v - STIFFNESS * x - z) / MASS,
            ALPHA * v - BETA * (GAMMA * abs(v) * z + DELTA * v * abs(z)),
        ]

    at = fine[::20]
    found = solve_ivp(slope, (0.0, at[-1]), [0.0, 0.0, 0.0], "DOP853", at, rtol=1e-8, atol=1e-10, max_step=fine[20])
    return Record(at, force[::20], found.y[0], "made", history=PERIOD)


if __name__ == "__main__":
    main()
