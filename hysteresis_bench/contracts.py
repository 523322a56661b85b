"""What a plugin promises: Model, Effect, Optimizer, Rig. Abstract here, final in the plugins.

A simulation is always of a swarm of parameter vectors; arrays are (samples, swarm), float64, swarm innermost and
contiguous. Settings are fields of a frozen dataclass. A plugin imports this module, `parameters`, `signals` and
`kernels`, and nothing above them, and what is slow to import inside its method: `list` stays fast.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar, Literal, Protocol, TypeAlias

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Dataset, Record, Signal

Start = Callable[[int], Array]
"""start(particles) -> (dimension, particles), shared by a trial's optimizers; the first columns are always the same."""

Acts: TypeAlias = Literal["law", "input", "output", "added"]
"""Where an effect acts, as the chain is ordered: inside or beside the law, on its input, its output, or only added."""

Family: TypeAlias = Literal[
    "law",
    "curve beside the law",
    "damping beside the law",
    "inertia beside the law",
    "curve of the input",
    "dynamics before the law",
    "curve of the output",
    "added disturbance",
    "change with time, path or temperature",
    "dynamics after the law",
    "cyclic error",
]
"""Effects of one family do alike. Of those that act in one place, the earlier family stands further inside."""

Property: TypeAlias = Literal["rate-independent", "odd", "masing", "return-point", "congruent"]
"""What a law does at any value of its parameters, without effects inside or around it.

rate-independent : the times of the samples do not matter;  odd : the input's mirror image gives the output's, from rest
masing : every branch is one curve from its reversal on, as far as the memory of the reversal before reaches
return-point : after an inner loop the output is what it was;  congruent : inner loops between two inputs are one curve
"""


@dataclass(frozen=True)
class Example:
    """With what a model makes data of its own, when effects are hidden in them.

    amplitude : of the drive;  parameters : values by name;  stream : of random numbers, like no other model's
    without : effects that no data can be made with
    """

    amplitude: float
    parameters: Mapping[str, float]
    stream: int
    without: tuple[str, ...] = ()


class Model(ABC):
    """A hysteresis model: input over time to output over time.

    Where a setting says how many parameters there are, `__post_init__` sets `parameters` and `linear` of the instance.
    What it must remember of the fitted range, such as its largest threshold, is a parameter with a box from the data.
    """

    parameters: ClassVar[tuple[Parameter, ...]]
    linear: ClassVar[tuple[str, ...]] = ()
    """Parameters in which the output is jointly affine, without effects inside: fits may eliminate them."""
    offers: ClassVar[Mapping[str, Effect]] = MappingProxyType({})
    """Effects that act inside the state equation, by name: the model applies them itself. With "eddy-current" around
    the model, `simulate` finds its parameters as p.eddy_current, a namedtuple like p; else p has no such field."""
    wants: ClassVar[Mapping[str, str]] = MappingProxyType({})  # units of columns that it has constants in
    properties: ClassVar[tuple[Property, ...]] = ()
    """What it has at all settings; laws are struck out where data refute it. Left out is what is not sure."""
    own_shapes: ClassVar[Mapping[str, str]] = MappingProxyType({})  # effects that may be its own shape, and why
    senses: ClassVar[tuple[int, ...]] = (-1, 1)  # of its loops, output over input: 1 anticlockwise, -1 clockwise
    example: ClassVar[Example | None] = None  # with what it makes data, where it may be asked to

    @abstractmethod
    def simulate(self, signal: Signal, p: Any) -> Array:
        """signal.input : (samples, 1) or (samples, swarm); p : namedtuple of (swarm,) arrays, one a
        parameter, in units -> (samples, swarm). Starts from the model's rest state at the first sample.
        Never NaN where the parameters lie in the box; never changes its arguments."""

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The parameters with bounds and scaling that suit these records."""
        return self.parameters

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        """Sentences about what in these records the model cannot follow, such as a sign or a centre."""
        return ()


@dataclass(frozen=True, eq=False)
class Hiding:
    """What a formula may depend on that hides an effect in made data.

    strength : 0 to 1, the larger the more the effect changes;  random : 0 to 1 each, for a sign, a phase and the like
    time, drive, temperature : (samples,), evenly and finely sampled, temperature in degC;  drive : before any effect
    step : of the time;  duration : of the longest record;  fastest : highest frequency of the drives, 1 / unit of time
    amplitude : largest drive;  top : the bare model's output there
    """

    strength: float
    random: tuple[float, float, float]
    time: Array
    drive: Array
    temperature: Array
    step: float
    duration: float
    fastest: float
    amplitude: float
    top: float


Response: TypeAlias = Callable[[Array], Array]
HiddenForm: TypeAlias = Callable[[Response, Array, Hiding], Array]
"""form(inner, u, hiding) -> output, (samples,), as Effect.apply by other formulas and code;  inner : what is wrapped"""


class Effect(ABC):
    """A physical effect around a model. At its null value it changes nothing, to the last bit."""

    parameters: ClassVar[tuple[Parameter, ...]]
    acts: ClassVar[Acts]
    family: ClassVar[Family]
    wants: ClassVar[Mapping[str, str]] = MappingProxyType({})  # as of a model
    nuisance: ClassVar[bool] = False  # estimated, never claimed; it stands outside all others that act where it does
    mistaken_for: ClassVar[Mapping[str, str]] = MappingProxyType({})
    """Other effects by name, and why data may not tell them from it, as a sentence ends. One of the two may say so."""
    affine: ClassVar[bool] = False  # is the output affine in what is wrapped? then so it is in its affine parameters
    relaxes: ClassVar[bool] = False  # does the output rise steadily to a whole step, as of a mixture of relaxations?
    linear: ClassVar[tuple[str, ...]] = ()
    """Parameters in which the output is affine, jointly with what is wrapped: amplitudes of what is merely added."""
    estimates: ClassVar[int] = 0
    """Values that it estimates anew on every record, beside its parameters."""
    accuracy: ClassVar[float] = 1e-9
    """By how much more samples of the same line may change the answer, of signals with ranges of about 1."""
    hidden_forms: ClassVar[tuple[HiddenForm, ...]] = ()
    """Formulas by which made data hide it. What the first one changes vanishes with the strength."""
    other_forms: ClassVar[tuple[HiddenForm, ...]] = ()
    """Other formulas of the field, which its own cannot reproduce. What they change vanishes with the strength."""

    @abstractmethod
    def apply(self, inner: Callable[[Signal], Array], signal: Signal, p: Any) -> Array:
        """inner(signal) runs what is wrapped -> (samples, swarm); change signal, output, or both. p as in simulate."""

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The parameters with bounds and scaling that suit these records."""
        return self.parameters

    def inapplicable(self, records: Sequence[Record]) -> str:
        """Why the effect cannot be fitted to these records, or an empty string."""
        return ""

    def adjust(self, simulated: Array, record: Record, p: Any = None) -> Array:
        """The output with what the effect estimates anew on every record; simulated : (samples, swarm)."""
        return simulated

    def offset(self, simulated: Array, record: Record, p: Any) -> Array:
        """The constant that the effect adds to this record's output, (swarm,): relative errors leave it out."""
        return np.zeros(simulated.shape[1])

    def starts(self, records: Sequence[Record], residuals: Sequence[Array]) -> list[dict[str, float]] | None:
        """Where its parameters may begin; None: residuals, (samples,) measured minus simulated, show nothing of it."""
        return []

    def remembered(self, offsets: Sequence[float]) -> Effect:
        """The effect as a fitted model keeps it; offsets : what it added to each of the fitted records."""
        return self


@dataclass(frozen=True)
class Part:
    """A fitted plugin as it goes on by one sample, behind an entry point of the group `hysteresis_bench.exports`:
    a function part(plugin, parameters by name, timed) in a module that has `law`, or `before` and `after`.

    constants : in p;  state : length of s;  invertible : has `inverse`, or `undone`;  not_undone : dynamics it lacks
    The function returns None for a part that changes nothing, and raises ValueError with why it cannot be exported.
    """

    constants: tuple[float, ...] = ()
    state: int = 0
    invertible: bool = False
    not_undone: str = ""


class Objective(Protocol):
    """What an optimizer sees: a metered loss on the unit box, always finite. Raises BudgetSpent (let it through) and
    OutsideBox for a point outside [0, 1]: how an algorithm treats its bounds is its own business."""

    @property
    def dimension(self) -> int: ...
    @property
    def budget(self) -> int: ...
    @property
    def evaluations(self) -> int: ...
    @property
    def linear(self) -> tuple[int, ...]:
        """Coordinates of the unit box in which the residuals are jointly affine."""

    def __call__(self, point: Array) -> float:
        """point : (dimension,) -> loss. One evaluation."""

    def many(self, points: Array) -> Array:
        """points : (dimension, swarm) -> (swarm,) losses; as many as the budget affords, then it raises BudgetSpent."""

    def residuals(self, point: Array) -> Array:
        """point : (dimension,) -> (scored samples,), simulated minus measured. One evaluation."""

    def residual_swarm(self, points: Array) -> Array:
        """points : (dimension, swarm) -> (scored samples, swarm), simulated minus measured; raises as `many` does."""


class Optimizer(ABC):
    """A search. Its settings are frozen dataclass fields."""

    anytime: ClassVar[bool] = True  # False where the schedule needs to know the budget

    @abstractmethod
    def search(self, objective: Objective, start: Start, rng: Generator) -> None:
        """Search the unit box until the budget is spent or nothing is left; the meter keeps a trace. Random: rng."""

    def evaluations_per_iteration(self, dimension: int) -> int | None:
        """What one iteration costs, where the algorithm has iterations in the papers' sense."""
        return None


@dataclass(frozen=True)
class Range:
    """Within which a constant differs from one specimen or set-up to the next, and why so."""

    lower: float
    upper: float
    why: str


class Rig(ABC):
    """A virtual test bench: a physical simulation that is the ground truth, never the model under test."""

    experiments: ClassVar[dict[str, str]]  # by name, a line on what can be measured
    units: ClassVar[Mapping[str, str]] = MappingProxyType({})
    """Of "time", "input" and "output"; a model in others is refused. One that is absent is not compared."""
    ranges: ClassVar[Mapping[str, Range]] = MappingProxyType({})
    """Settings that are drawn where a study asks for several instances, with the drive's among them."""

    @abstractmethod
    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One experiment -> a dataset with units and, in `hidden`, what was hidden in it."""


class DrivenRig(Rig):
    """A rig that plays any drive."""

    @abstractmethod
    def play(self, drive: Record, rng: Generator) -> Dataset:
        """One record of the drive's name, from rest, sampled as the rig does; its input is what the rig could follow.
        drive : evenly sampled from 0 on, linear between its samples, in the rig's units, all of which are told."""


class Plant(Protocol):
    """A sampled actuator: a state goes in, a new state comes out, nothing is kept between."""

    def rest(self) -> Any:
        """The state before anything happens."""

    def step(self, state: Any, voltage: float) -> Any:
        """One interval later, the voltage held."""

    def displacement(self, state: Any) -> float:
        """The true output."""

    def read(self, state: Any, rng: Generator) -> float:
        """What the sensor says."""


class SteppedRig(Rig):
    """A rig that a controller can drive, sample by sample."""

    @abstractmethod
    def plant(self, rate: float) -> Plant:
        """The rig as a sampled actuator; rate : samples a second."""

    @property
    @abstractmethod
    def input_limit(self) -> float:
        """Largest input, to either side."""

    @property
    @abstractmethod
    def noise_floor(self) -> float:
        """RMS of what the sensor adds, unit of the output."""
