"""A hysteresis model with effects hidden in its data, for finding out whether a diagnosis names them."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.random import Generator, default_rng

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import DrivenRig, Example, HiddenForm, Hiding, Model, Response
from hysteresis_bench.diagnosis.hypotheses.systems import place
from hysteresis_bench.diagnosis_study.imperfections import IMPERFECTIONS, noisy
from hysteresis_bench.signals import UNITLESS, Dataset, Record, Signal

DURATION, SAMPLES, FINER = 3.0, 800, 8
"""s and samples of a record, at least 60 a cycle, so that samples miss little of a reversal; everything is computed
with steps that many times finer."""

STEP = DURATION / (SAMPLES * FINER)
"""s, with which everything is computed: some formulas depend on it."""

FASTEST = 4.0
"""Hz, of the drives."""

CALIBRATED = ("slow", "fast", "nested", "sweep")


def can_make_data() -> tuple[str, ...]:
    """Names of the models that data can be made with: those that declare an example."""
    loaded = {name: registry.load("models", name).loaded for name in registry.usable("models")}
    return tuple(name for name, model in loaded.items() if getattr(model, "example", None))


def can_be_hidden(model: Model) -> tuple[str, ...]:
    """Names of the effects that data of a model can hide: those that can be claimed and say how to hide them. Of
    those that act inside a law only what the model offers."""
    known = {*model.offers, *registry.usable("effects")}
    effects = {name: registry.effect(name) for name in known - {*(model.example.without if model.example else ())}}
    return tuple(sorted(name for name, one in effects.items() if one.hidden_forms and not one.nuisance))


def hiding(inner: Response, hidden: Mapping[str, tuple[HiddenForm, Hiding]]) -> Response:
    """A response with formulas around it, in the order of the chain; hidden : formula and conditions by effect."""
    for name in sorted(hidden, key=lambda name: place(name, registry.effect(name))):
        inner = _around(inner, *hidden[name])
    return inner


def _around(inner: Response, form: HiddenForm, conditions: Hiding) -> Response:
    return lambda u: form(inner, u, conditions)


@dataclass(frozen=True)
class HiddenEffects(DrivenRig):
    """A hysteresis model with up to all effects hidden, made by formulas and finer steps of their own.

    Departs from the contract on purpose: the hysteresis is that of a model, so that whatever else is in the data
    is known. The effects are made without their own code, by the first formula that each declares for this, on
    a grid eight times finer than the samples. Each is as strong as to change the output by 4 to 8 times the noise
    (RMS) beyond what another gain, another offset and a linear share of the input take up, or as strong as
    it gets; so it is to be seen, and leaving it out costs more than the noise.

    model : whose hysteresis it is, of those that declare an example
    effects : what is hidden, by name; empty leaves it to `hide` and `draw`
    hide : how many effects are hidden where none is named;  among : which ones may be; empty: all that can be
    draw : which parameters, strengths and (where none is named) effects; the same in every experiment
    noise : standard deviation, share of the output's range; 0 draws it between 0.002 and 0.01
    other : hide by one of the other formulas of the field that an effect declares, drawn, where it has some
    imperfect : what is wrong with the records beside white noise, of `IMPERFECTIONS`; empty: nothing
    """

    units: ClassVar[Mapping[str, str]] = UNITLESS
    experiments: ClassVar[dict[str, str]] = {
        "slow": "sine at 1 Hz that decays",
        "fast": "sine at 3 Hz that swells",
        "nested": "minor loops of 2 Hz in major ones",
        "sweep": "sine from 0.5 to 4 Hz",
        "mixed": "sum of sines at 0.7, 1.6 and 2.9 Hz",
        "stairs": "steps up and down, each held",
    }

    model: str = registry.BOUC_WEN
    effects: tuple[str, ...] = ()
    hide: int = 0
    among: tuple[str, ...] = ()
    draw: int = 0
    noise: float = 0.0
    other: bool = False
    imperfect: str = ""

    def __post_init__(self) -> None:
        models = can_make_data()
        if self.model not in models:
            raise ValueError(f"no data can be made with the model {self.model!r}; there are: {', '.join(models)}")
        known = can_be_hidden(self._law)
        unknown = [name for name in (*self.effects, *self.among) if name not in known]
        if unknown:
            raise ValueError(f"no effect {unknown[0]!r} can be hidden; there are: {', '.join(known)}")
        if not 0 <= self.hide <= len(self._pool):
            raise ValueError(f"hide = {self.hide} must be between 0 and {len(self._pool)}")
        if self.noise < 0.0:
            raise ValueError(f"noise = {self.noise} must not be negative")
        if self.imperfect and self.imperfect not in IMPERFECTIONS:
            raise ValueError(f"imperfect = {self.imperfect!r} is not known; there are: {', '.join(IMPERFECTIONS)}")

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record with the column temperature. Raises ValueError for an unknown experiment."""
        if experiment not in self.experiments:
            raise ValueError(f'no experiment "{experiment}". Known: {", ".join(self.experiments)}')
        return self._measured(experiment, *self._setting(experiment), rng)

    def play(self, drive: Record, rng: Generator) -> Dataset:
        """A record of the drive's name, sampled as the experiments are."""
        time = np.arange(round(float(drive.time[-1]) / STEP) + 1) * STEP
        temperature = _temperature(time, len(self.experiments))
        return self._measured(drive.name, time, np.interp(time, drive.time, drive.input), temperature, rng)

    def _measured(self, name: str, time: Array, drive: Array, temperature: Array, rng: Generator) -> Dataset:
        output = self._response(time, drive, temperature, self._strengths)
        handed = slice(None, None, FINER)
        units = {**self.units, "temperature": "degC"}
        record = Record(time[handed], drive[handed], output[handed], name, units, {"temperature": temperature[handed]})
        record = IMPERFECTIONS.get(self.imperfect, noisy)(record, self._noise_rms, rng)
        return Dataset((record,), hidden={**dict.fromkeys(self.names, True), "noise": self._noise_rms})

    @cached_property
    def names(self) -> tuple[str, ...]:
        """What is hidden: one effect after the other as draws go on, and others at random beside it."""
        if self.effects or not self.hide:
            return tuple(sorted(self.effects))
        shuffled = [str(name) for name in default_rng(self._example.stream).permutation(self._pool)]
        first = shuffled.pop(self.draw % len(self._pool))
        return tuple(sorted([first, *map(str, self._stream("names").choice(shuffled, self.hide - 1, replace=False))]))

    @cached_property
    def _law(self) -> Model:
        model: Model = registry.build("models", self.model)
        return model

    @property
    def _example(self) -> Example:
        assert self._law.example is not None
        return self._law.example

    @cached_property
    def _pool(self) -> tuple[str, ...]:
        return tuple(sorted(self.among)) or can_be_hidden(self._law)

    @cached_property
    def _noise_rms(self) -> float:
        share = self.noise or self._stream("noise").uniform(0.002, 0.01)
        return float(share * self._span)

    @cached_property
    def _bare(self) -> Array:
        """The hysteresis alone, (records, fine samples)."""
        return np.stack([self._response(*self._setting(record), {}) for record in CALIBRATED])

    @cached_property
    def _span(self) -> float:
        return float(np.max(np.ptp(self._bare, axis=1)))

    @cached_property
    def _top(self) -> float:
        """The output at the largest input, coming from rest."""
        return float(self._hysteresis(np.linspace(0.0, self._example.amplitude, SAMPLES * FINER))[-1])

    @cached_property
    def _strengths(self) -> dict[str, float]:
        """Of each hidden effect, 0 to 1."""
        return {name: self._visible(name, self._stream(name, "seen").uniform(4.0, 8.0)) for name in self.names}

    def _stream(self, *purpose: str) -> Generator:
        """Random numbers for one purpose of this draw."""
        return default_rng([self.draw, self._example.stream, *"|".join(purpose).encode()])

    def _visible(self, name: str, times: float) -> float:
        """The strength that changes the output by so many times the noise."""
        low, high = 1e-4, 1.0
        for _ in range(8):
            middle = float(np.sqrt(low * high))
            low, high = (low, middle) if self._change(name, middle) > times * self._noise_rms else (middle, high)
        return high

    def _change(self, name: str, strength: float) -> float:
        """RMS of what an effect alone changes, beyond a gain, an offset and a share of the input."""
        changed = [self._response(*self._setting(record), {name: strength}) for record in CALIBRATED]
        drives = [self._setting(record)[1] for record in CALIBRATED]
        y, columns = self._bare.ravel(), np.concatenate(drives)
        target = np.concatenate(changed) - y
        basis = np.column_stack([np.ones(y.size), y / np.ptp(y), columns / np.ptp(columns)])
        left = target - basis @ np.linalg.lstsq(basis, target, rcond=None)[0]
        return float(np.sqrt(np.mean(left**2)))

    def _setting(self, experiment: str) -> tuple[Array, Array, Array]:
        """Time in s, drive and temperature in degC, on the fine grid."""
        time = np.arange(SAMPLES * FINER) * STEP
        number = list(self.experiments).index(experiment)
        return time, self._example.amplitude * _DRIVES[experiment](time), _temperature(time, number)

    def _response(self, time: Array, drive: Array, temperature: Array, strengths: Mapping[str, float]) -> Array:
        """The output without noise on the fine grid, with effects of these strengths."""
        amplitude, top, hidden = self._example.amplitude, self._top, {}
        for name, strength in strengths.items():
            free = tuple(self._stream(name, "more").random(3).tolist())
            given = Hiding(strength, free, time, drive, temperature, float(time[1]), DURATION, FASTEST, amplitude, top)
            hidden[name] = (self._form(name), given)
        return hiding(self._hysteresis, hidden)(drive)

    def _hysteresis(self, drive: Array) -> Array:
        """Of a drive on the fine grid."""
        time = np.arange(drive.size) * STEP
        return self._law.simulate(Signal(time, np.ascontiguousarray(drive[:, None])), self._values)[:, 0]

    def _form(self, name: str) -> HiddenForm:
        effect = registry.effect(name)
        if not (self.other and effect.other_forms):
            return effect.hidden_forms[0]
        return effect.other_forms[int(self._stream(name, "form").integers(len(effect.other_forms)))]

    @cached_property
    def _values(self) -> Any:
        """The model's parameters, (1,) each."""
        centre = self._example.parameters
        shares = self._stream("parameters").uniform(0.85, 1.15, len(centre))
        values = {name: np.array([value * share]) for (name, value), share in zip(centre.items(), shares, strict=True)}
        return namedtuple("Values", list(values))(**values)


def _temperature(time: Array, number: int) -> Array:
    """degC, during the experiment of this number."""
    return 22.0 + 9.0 * np.sin(2.0 * np.pi * (time / (1.3 * DURATION) + 0.37 * number))


def _stairs(time: Array) -> Array:
    """Nine levels, each reached within 80 ms and held."""
    levels = np.array([0.0, 0.6, 1.0, 0.3, -0.5, -1.0, -0.2, 0.8, -0.7, 0.0])
    starts = np.arange(1, levels.size) * DURATION / levels.size
    at = np.ravel(np.column_stack([starts, starts + 0.08]))
    level: Array = np.interp(time, at, np.ravel(np.column_stack([levels[:-1], levels[1:]])))
    return level


_DRIVES: dict[str, Callable[[Array], Array]] = {
    "slow": lambda t: np.sin(2.0 * np.pi * t) * (1.0 - 0.2 * t),
    "fast": lambda t: np.sin(6.0 * np.pi * t) * (0.4 + 0.2 * t),
    "nested": lambda t: 0.7 * np.sin(2.0 * np.pi * 0.6 * t) + 0.3 * np.sin(2.0 * np.pi * 2.1 * t),
    "sweep": lambda t: 0.9 * np.sin(2.0 * np.pi * (0.5 * t + 1.75 / DURATION * t**2)),
    "mixed": lambda t: 0.4 * np.sin(1.4 * np.pi * t) + 0.35 * np.sin(3.2 * np.pi * t) + 0.25 * np.sin(5.8 * np.pi * t),
    "stairs": _stairs,
}
