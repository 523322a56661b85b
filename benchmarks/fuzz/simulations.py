"""Every model and every effect, at random points and corners of its boxes, on signals as nobody measures them."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from hypothesis import strategies as st

from benchmarks.fuzz.target import Target, Wrong
from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.data.data_files import LARGEST, SHORTEST
from hysteresis_bench.parameters import Space
from hysteresis_bench.signals import INDEX, Record

SWARM = 3
MODELS = ("bouc-wen", "hammerstein", "jiles-atherton", "free-energy")
"""Around which effects are put."""
AMPLITUDES = st.one_of(st.sampled_from([0.0, 1e-300, 1e-150, 1e-9, 1.0, 1e9, 1e100, 1e150]), st.floats(1e-3, 1e3))
SHAPES = ("noise", "sine", "constant", "zero", "step", "spikes")
STEPS = ("even", "uneven", "repeated", "tiny", "huge", "index")

signals = st.fixed_dictionaries(
    {
        "samples": st.one_of(st.sampled_from([1, 2, 3]), st.integers(4, 80)),
        "amplitude": AMPLITUDES,
        "offset": st.one_of(st.just(0.0), AMPLITUDES),
        "shape": st.sampled_from(SHAPES),
        "steps": st.sampled_from(STEPS),
        "seed": st.integers(0, 2**32 - 1),
    }
)


def record_of(given: dict[str, Any]) -> Record:
    """One that a description stands for."""
    rng, samples = np.random.default_rng(given["seed"]), given["samples"]
    wave = {
        "noise": rng.uniform(-1.0, 1.0, samples),
        "sine": np.sin(np.linspace(0.0, 15.0, samples)),
        "constant": np.ones(samples),
        "zero": np.zeros(samples),
        "step": (np.arange(samples) > samples // 2).astype(float),
        "spikes": np.where(rng.random(samples) < 0.1, rng.choice([-1.0, 1.0], samples), 0.0),
    }[given["shape"]]
    step = {
        "even": np.full(samples, 0.01),
        "uneven": 10.0 ** rng.uniform(-6.0, 1.0, samples),
        "repeated": rng.choice([0.0, 0.01], samples),
        "tiny": np.full(samples, 1e-100),
        "huge": np.full(samples, 1e90),
        "index": np.ones(samples),
    }[given["steps"]]
    drive = given["offset"] + given["amplitude"] * wave
    units = {"time": INDEX if given["steps"] == "index" else "s", "input": "V", "output": "um", "temperature": "degC"}
    output = drive + 0.2 * given["amplitude"] * rng.uniform(-1.0, 1.0, samples)
    warm = {"temperature": 20.0 + rng.uniform(-1.0, 30.0, samples)}
    return Record(np.cumsum(step), drive, output, units=units, columns=warm)


def fittable(system: System, record: Record) -> bool:
    """Whether a file with these samples is read, and every effect may be fitted to it."""
    measured = (record.time, record.input, record.measured)
    within = record.time.size > 1 and all(np.max(np.abs(values)) <= LARGEST for values in measured)
    if not within or np.min(np.diff(record.time)) < SHORTEST or np.ptp(record.input) < SHORTEST:
        return False
    return not any(effect.inapplicable([record]) for _, effect in system.effects)


@cache
def system_of(model: str, effect: str | None) -> System:
    built = registry.build("models", model)
    return System(built, registry.build_effects(built, [effect] if effect else []))


@st.composite
def cases(draw: st.DrawFn) -> dict[str, Any]:
    """A system, a signal, and points in one of the boxes, each coordinate at a corner or inside."""
    effects = [None, *registry.names("effects"), *registry.offered()]
    effect = draw(st.sampled_from(effects))
    models = registry.offered().get(effect, MODELS) if effect else registry.names("models")
    model = draw(st.sampled_from(sorted(models)))
    places = st.one_of(st.sampled_from([0.0, 1.0, 0.5]), st.floats(0.0, 1.0))
    dimension = len(system_of(model, effect).parameters)
    columns = st.lists(places, min_size=dimension, max_size=dimension)
    points = draw(st.lists(columns, min_size=SWARM, max_size=SWARM))
    of_data = draw(st.booleans())
    return {"model": model, "effect": effect, "box": "data" if of_data else "own", "points": points, **draw(signals)}


def simulate(given: dict[str, Any]) -> None:
    """Raises Wrong for what is not finite, and for a box that is none."""
    record = record_of(given)
    system = system_of(given["model"], given["effect"])
    of_data = given["box"] == "data" and fittable(system, record)
    box = system.box([record]) if of_data else system.parameters
    if faults := [fault for parameter in box for fault in parameter.faults()]:
        raise Wrong(f"{given['model']} with {given['effect']}: no box: {faults[0].split(':')[0]}")
    values = Space(box).from_unit(np.array(given["points"]).T.reshape(len(box), SWARM))
    answer = system.respond(record, values)
    if answer.shape != (record.time.size, SWARM):
        raise Wrong(f"{given['model']} with {given['effect']}: shape {answer.shape}")
    if not np.all(np.isfinite(answer)):
        steps = f"amplitude {given['amplitude']:g}, steps {given['steps']}, {min(given['samples'], 3)} samples"
        raise Wrong(f"{given['model']} with {given['effect']}: not finite at {steps}, box {given['box']}")


TARGETS = (Target("models and effects", cases(), simulate, 30),)
