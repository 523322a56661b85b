"""A hysteresis model with effects hidden in its data, for finding out whether a diagnosis names them."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.random import Generator, default_rng

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Model, Rig
from hysteresis_bench.signals import Dataset, Record, Signal
from hysteresis_plugins.models.bouc_wen import BoucWen
from hysteresis_plugins.models.free_energy import FreeEnergy
from hysteresis_plugins.models.jiles_atherton import JilesAtherton

DURATION, SAMPLES, FINER = 3.0, 800, 8
"""s and samples of a record, at least 60 a cycle, so that samples miss little of a reversal; everything is computed
with steps that many times finer."""

LONGEST = 0.05
"""s; the longest lag or delay, at drives of up to 4 Hz."""

CALIBRATED = ("slow", "fast", "nested", "sweep")

MODELS: dict[str, tuple[Model, float, dict[str, float]]] = {
    "bouc-wen": (BoucWen(), 4.0, {"alpha": 0.35, "beta": 0.7, "gamma": 0.15, "d": 1.2}),
    "jiles-atherton": (JilesAtherton(), 5000.0, {"alpha": 3e-4, "a": 1100.0, "k": 900.0, "M_s": 1.3e6, "c": 0.2}),
    "free-energy": (FreeEnergy(), 4.0, {"M_R": 1.0, "eta": 4.0, "H_c": 1.1, "b": 1.0, "c": 0.35, "alpha": 0.6}),
}
"""Amplitude of the drive and parameters about which those of a draw lie; ours."""

EFFECTS = (
    "asymmetry",
    "backlash",
    "creep",
    "drift",
    "fatigue",
    "input-lag",
    "output-lag",
    "periodic-disturbance",
    "resonance",
    "saturation",
    "temperature-sensitivity",
    "transport-delay",
)


@dataclass(frozen=True)
class HiddenEffects(Rig):
    """One of three hysteresis models with up to three effects hidden, made by formulas and finer steps of its own.

    Departs from the contract on purpose: the hysteresis is that of a model, so that whatever else is in the data
    is known. The effects are written without the plugins' code: Euler steps, shifts and bodies between walls on
    a grid eight times finer than the samples. Each is as strong as to change the output by 4 to 8 times the noise
    (RMS) beyond what another gain, another offset and a linear share of the input take up, or as strong as
    it gets; so it is to be seen, and leaving it out costs more than the noise.

    model : whose hysteresis it is;  effects : what is hidden, by name; empty leaves it to `hide` and `draw`
    hide : how many of all effects are hidden where none is named
    draw : which parameters, strengths and (where none is named) effects; the same in every experiment
    noise : standard deviation, share of the output's range; 0 draws it between 0.002 and 0.01
    """

    experiments: ClassVar[dict[str, str]] = {
        "slow": "sine at 1 Hz that decays",
        "fast": "sine at 3 Hz that swells",
        "nested": "minor loops of 2 Hz in major ones",
        "sweep": "sine from 0.5 to 4 Hz",
        "mixed": "sum of sines at 0.7, 1.6 and 2.9 Hz",
        "stairs": "steps up and down, each held",
    }

    model: Literal["bouc-wen", "jiles-atherton", "free-energy"] = "bouc-wen"
    effects: tuple[str, ...] = ()
    hide: int = 0
    draw: int = 0
    noise: float = 0.0

    def __post_init__(self) -> None:
        unknown = [name for name in self.effects if name not in EFFECTS]
        if unknown:
            raise ValueError(f"no effect {unknown[0]!r} can be hidden; there are: {', '.join(EFFECTS)}")
        if not 0 <= self.hide <= len(EFFECTS):
            raise ValueError(f"hide = {self.hide} must be between 0 and {len(EFFECTS)}")
        if self.noise < 0.0:
            raise ValueError(f"noise = {self.noise} must not be negative")

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record with the column temperature. Raises ValueError for an unknown experiment."""
        if experiment not in self.experiments:
            raise ValueError(f'no experiment "{experiment}". Known: {", ".join(self.experiments)}')
        time, drive, temperature = self._setting(experiment)
        output = self._response(experiment, self._strengths)
        handed = slice(None, None, FINER)
        measured = output[handed] + self._noise_rms * rng.standard_normal(SAMPLES)
        units = {"time": "s", "input": "1", "output": "1", "temperature": "degC"}
        record = Record(time[handed], drive[handed], measured, experiment, units, {"temperature": temperature[handed]})
        return Dataset((record,), hidden={**dict.fromkeys(self.names, True), "noise": self._noise_rms})

    @cached_property
    def names(self) -> tuple[str, ...]:
        """What is hidden: one effect after the other as draws go on, and others at random beside it."""
        if self.effects or not self.hide:
            return tuple(sorted(self.effects))
        shuffled = [str(name) for name in default_rng(sorted(MODELS).index(self.model)).permutation(EFFECTS)]
        first = shuffled.pop(self.draw % len(EFFECTS))
        return tuple(sorted([first, *map(str, self._stream("names").choice(shuffled, self.hide - 1, replace=False))]))

    @cached_property
    def _noise_rms(self) -> float:
        share = self.noise or self._stream("noise").uniform(0.002, 0.01)
        return float(share * self._span)

    @cached_property
    def _span(self) -> float:
        return max(float(np.ptp(self._response(name, {}))) for name in CALIBRATED)

    @cached_property
    def _strengths(self) -> dict[str, float]:
        """Of each hidden effect, 0 to 1."""
        return {name: self._visible(name, self._stream(name, "seen").uniform(4.0, 8.0)) for name in self.names}

    def _stream(self, *purpose: str) -> Generator:
        """Random numbers for one purpose of this draw."""
        return default_rng([self.draw, sorted(MODELS).index(self.model), *"|".join(purpose).encode()])

    def _visible(self, name: str, times: float) -> float:
        """The strength that changes the output by so many times the noise."""
        low, high = 1e-4, 1.0
        for _ in range(8):
            middle = float(np.sqrt(low * high))
            low, high = (low, middle) if self._change(name, middle) > times * self._noise_rms else (middle, high)
        return high

    def _change(self, name: str, strength: float) -> float:
        """RMS of what an effect alone changes, beyond a gain, an offset and a share of the input."""
        bare = [self._response(record, {}) for record in CALIBRATED]
        changed = [self._response(record, {name: strength}) for record in CALIBRATED]
        drives = [self._setting(record)[1] for record in CALIBRATED]
        y, columns = np.concatenate(bare), np.concatenate(drives)
        target = np.concatenate(changed) - y
        basis = np.column_stack([np.ones(y.size), y / np.ptp(y), columns / np.ptp(columns)])
        left = target - basis @ np.linalg.lstsq(basis, target, rcond=None)[0]
        return float(np.sqrt(np.mean(left**2)))

    def _setting(self, experiment: str) -> tuple[Array, Array, Array]:
        """Time in s, drive and temperature in degC, on the fine grid."""
        time = np.arange(SAMPLES * FINER) * (DURATION / (SAMPLES * FINER))
        number = list(self.experiments).index(experiment)
        temperature = 22.0 + 9.0 * np.sin(2.0 * np.pi * (time / (1.3 * DURATION) + 0.37 * number))
        return time, MODELS[self.model][1] * _DRIVES[experiment](time), temperature

    def _response(self, experiment: str, strengths: dict[str, float]) -> Array:
        """The output without noise on the fine grid, with effects of these strengths."""
        model, amplitude, centre = MODELS[self.model]
        time, drive, temperature = self._setting(experiment)
        step = float(time[1])
        u = drive
        for name in ("input-lag", "asymmetry", "backlash"):
            if name in strengths:
                u = _ON_INPUT[name](u, strengths[name], amplitude, step, self._stream(name, "more").random(3))
        shares = self._stream("parameters").uniform(0.85, 1.15, len(centre))
        values = {name: np.array([value * share]) for (name, value), share in zip(centre.items(), shares, strict=True)}
        p: Any = namedtuple("Values", list(values))(**values)
        y = model.simulate(Signal(time, np.ascontiguousarray(u[:, None])), p)[:, 0]
        top = model.simulate(Signal(time, np.linspace(0.0, amplitude, time.size)[:, None]), p)[-1, 0]
        given = _Given(time, drive, temperature, step, amplitude, float(top))
        for name in _ON_OUTPUT:
            if name in strengths:
                y = _ON_OUTPUT[name](y, strengths[name], given, self._stream(name, "more").random(3))
        return y


@dataclass(frozen=True)
class _Given:
    """What effects on the output may depend on; top : the output at the largest drive."""

    time: Array
    drive: Array
    temperature: Array
    step: float
    amplitude: float
    top: float


def _lagged(x: Array, constant: float, step: float) -> Array:
    """First order, explicit Euler with the mean of both ends."""
    share, state = step / max(constant, step), float(x[0])
    out = np.empty_like(x)
    out[0] = state
    for k in range(1, x.size):
        state += share * (0.5 * (x[k] + x[k - 1]) - state)
        out[k] = state
    return out


def _between_walls(u: Array, half: float) -> Array:
    """A body that is pushed by two walls around it."""
    out, body = np.empty_like(u), float(u[0])
    for k, middle in enumerate(u.tolist()):
        body = float(np.clip(body, middle - half, middle + half))
        out[k] = body
    return out


def _sprung(x: Array, period: float, damping: float, step: float) -> Array:
    """A mass on a spring and damper, semi-implicit Euler in ten parts of a step."""
    omega, place, speed = 2.0 * np.pi / period, float(x[0]), 0.0
    out, part = np.empty_like(x), step / 10.0
    out[0] = place
    for k in range(1, x.size):
        for j in range(10):
            target = x[k - 1] + (x[k] - x[k - 1]) * (j + 0.5) / 10.0
            speed += part * (omega**2 * (target - place) - 2.0 * damping * omega * speed)
            place += part * speed
        out[k] = place
    return out


def _crept(y: Array, s: float, g: _Given, r: Array) -> Array:
    late = 0.6 * s / 3.0
    times = 0.04 * 8.0 ** r[0] * np.array([0.3, 1.0, 3.0])
    return (1.0 - 3.0 * late) * y + late * sum(_lagged(y, float(tau), g.step) for tau in times)


def _shifted(y: Array, s: float, g: _Given, r: Array) -> Array:
    late = max(1, round(LONGEST * s / g.step))
    return np.concatenate([np.full(late, y[0]), y[:-late]])


def _tired(y: Array, s: float, g: _Given, r: Array) -> Array:
    path = np.append(0.0, np.cumsum(np.abs(np.diff(g.drive)))) / (40.0 * g.amplitude)
    return y * np.exp2(-3.0 * s * path)


def _hummed(y: Array, s: float, g: _Given, r: Array) -> Array:
    return y + 0.3 * s * g.top * np.cos(2.0 * np.pi * ((11.0 + 25.0 * r[0]) * g.time + r[1]))


_ON_INPUT: dict[str, Callable[[Array, float, float, float, Array], Array]] = {
    "input-lag": lambda u, s, amplitude, step, r: _lagged(u, LONGEST * s, step),
    "asymmetry": lambda u, s, amplitude, step, r: u * (1.0 + np.sign(r[0] - 0.5) * 0.45 * s * u / amplitude),
    "backlash": lambda u, s, amplitude, step, r: _between_walls(u, 0.25 * s * amplitude),
}
_ON_OUTPUT: dict[str, Callable[[Array, float, _Given, Array], Array]] = {
    "saturation": lambda y, s, g, r: np.tanh(2.0 * s * y / g.top) * g.top / (2.0 * s),
    "fatigue": _tired,
    "temperature-sensitivity": lambda y, s, g, r: y * (1.0 + 0.04 * s * (g.temperature - 20.0)),
    "creep": _crept,
    "output-lag": lambda y, s, g, r: _lagged(y, LONGEST * s, g.step),
    "resonance": lambda y, s, g, r: _sprung(y, 0.02 + 0.18 * s, 0.1 + 0.4 * r[0], g.step),
    "transport-delay": _shifted,
    "periodic-disturbance": _hummed,
    "drift": lambda y, s, g, r: y + s * g.top * g.time / DURATION,
}


def _stairs(time: Array) -> Array:
    """Nine levels, each reached within 80 ms and held."""
    levels = np.array([0.0, 0.6, 1.0, 0.3, -0.5, -1.0, -0.2, 0.8, -0.7, 0.0])
    starts = np.arange(1, levels.size) * DURATION / levels.size
    at = np.ravel(np.column_stack([starts, starts + 0.08]))
    return np.interp(time, at, np.ravel(np.column_stack([levels[:-1], levels[1:]])))


_DRIVES: dict[str, Callable[[Array], Array]] = {
    "slow": lambda t: np.sin(2.0 * np.pi * t) * (1.0 - 0.2 * t),
    "fast": lambda t: np.sin(6.0 * np.pi * t) * (0.4 + 0.2 * t),
    "nested": lambda t: 0.7 * np.sin(2.0 * np.pi * 0.6 * t) + 0.3 * np.sin(2.0 * np.pi * 2.1 * t),
    "sweep": lambda t: 0.9 * np.sin(2.0 * np.pi * (0.5 * t + 1.75 / DURATION * t**2)),
    "mixed": lambda t: 0.4 * np.sin(1.4 * np.pi * t) + 0.35 * np.sin(3.2 * np.pi * t) + 0.25 * np.sin(5.8 * np.pi * t),
    "stairs": _stairs,
}
