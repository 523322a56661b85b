"""Hysteresis in feedback: a mass on a hysteretic spring, driven by a force.

[1] Y.-K. Wen, J. Engineering Mechanics Division 102 (1976) 249.
[2] J. P. Noël, M. Schoukens, Hysteretic benchmark with a dynamic nonlinearity, Workshop on Nonlinear System
    Identification Benchmarks, Brussels (2016).

Legend: u force, x displacement, z the force of the spring, a hysteresis law of x.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import dominant_frequency
from hysteresis_plugins.models._data import steepness
from hysteresis_plugins.models._plays import at_least, named, thresholds
from hysteresis_plugins.models.bouc_wen import BoucWen
from hysteresis_plugins.models.bouc_wen_generalized import BoucWenGeneralized
from hysteresis_plugins.models.dahl import Dahl
from hysteresis_plugins.models.maxwell_slip import MaxwellSlip
from hysteresis_plugins.models.prandtl_ishlinskii import PrandtlIshlinskii
from hysteresis_plugins.models.preisach import Preisach

Law = Literal["bouc-wen", "bouc-wen-generalized", "dahl", "maxwell-slip", "prandtl-ishlinskii", "preisach"]
LAWS: Mapping[str, Any] = {
    "bouc-wen": BoucWen(),
    "bouc-wen-generalized": BoucWenGeneralized(),
    "dahl": Dahl(),
    "maxwell-slip": MaxwellSlip(),
    "prandtl-ishlinskii": PrandtlIshlinskii(),
    "preisach": Preisach(),
}
NARROWED = {"alpha": (0.025, 1.0), "beta": (3.0, 0.1), "gamma": (0.2, 0.2)}
"""Shares of the edges of Bouc-Wen's box that are kept."""
RUNAWAY = 1e9
"""Where Bouc-Wen's h has no bound it is cut at this many times the largest force."""


def _exchanged(parameter: Parameter) -> Parameter:
    """A law's parameter where its input is the model's output, and its output the model's input."""
    unit = parameter.unit.replace("{input}", "{}").replace("{output}", "{input}").replace("{}", "{output}")
    return replace(parameter, unit=unit)


def _parameters(law: str) -> tuple[Parameter, ...]:
    return (
        Parameter("mass", 1e-3, 10.0, "{input} {time}^2/{output}", "log", meaning="that moves", positive=True),
        Parameter("damping", 1e-4, 1.0, "{input} {time}/{output}", "log", meaning="viscous", positive=True),
        *(_exchanged(parameter) for parameter in LAWS[law].parameters),
    )


@dataclass(frozen=True)
class Oscillator(Model):
    """Hysteresis in feedback: a mass on a hysteretic spring that a force drives.

    mass x'' + damping x' + z = u, z = law[x], see [1, 2]: the output is x. The spring's linear part is the law's own,
    k x of the literature: d, slope, or the first coefficient. Rate-dependent.

    law : a shipped law that acts on the displacement, with its default settings
    substeps : integration steps a sample, 1 to 200; the force between samples is a cubic spline

    Average acceleration, A-stable and second order: at 20 steps a period the period is wrong by 0.8 %, at 80 by 0.05 %.
    Ours: it begins at rest at x = 0, the law in its rest state. Where time is only an index, the sample is its unit.
    """

    parameters = _parameters("bouc-wen")

    law: Law = "bouc-wen"
    substeps: int = 8

    def __post_init__(self) -> None:
        at_least("substeps", self.substeps, 1, 200)
        object.__setattr__(self, "parameters", _parameters(self.law))

    def simulate(self, signal: Signal, p: Any) -> Array:
        from hysteresis_bench.kernels import oscillator as kernels

        if signal.time.size < 2:
            return np.zeros((signal.time.size, p.mass.size))
        time, force = signal.finer(self.substeps)
        driven = (force, np.diff(time), self.substeps, p.mass, p.damping)
        if self.law == "bouc-wen":
            bound = np.full_like(p.mass, RUNAWAY * np.max(np.abs(force)))
            return kernels.bouc_wen_oscillator(*driven, np.stack([p.alpha, p.beta, p.gamma, p.d, bound]))
        if self.law == "bouc-wen-generalized":
            return kernels.generalized_oscillator(*driven, np.stack(p[2:]))
        if self.law == "dahl":
            return kernels.dahl_oscillator(*driven, np.stack(p[2:]))
        if self.law == "maxwell-slip":
            law = LAWS[self.law]
            stiffnesses = [getattr(p, name) for name in named("k", law.elements)]
            rows = np.concatenate([np.stack([p.slope, p.gap]), law.limits(p.radius), stiffnesses])
            return kernels.stops_oscillator(*driven, rows, law.elements)
        plays = LAWS[self.law].plays
        rows = np.concatenate([thresholds(p.radius, plays), np.stack(p[3:])])
        return kernels.plays_oscillator(*driven, rows, plays + 1)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Mass and damping about those of the linear oscillator that fits the records best, within a factor of 3 and
        from a thousandth to three times; the law's box for a force over the displacement that is as steep as that
        oscillator's spring, with stiffnesses of its linear part above 0."""
        measured = [record for record in records if record.output is not None]
        m, c, k = linear_oscillator(measured)
        force = k / steepness([_swapped(record, 1.0) for record in measured])
        mass, damping, *_ = self.parameters
        return (
            mass.within(m / 3.0, 3.0 * m),
            damping.within(1e-3 * c, 3.0 * c),
            *(_stiff(_exchanged(q)) for q in LAWS[self.law].box([_swapped(one, force) for one in measured])),
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        if not all(record.timed for record in records):
            return ("Time is only an index here: mass and damping are told in samples.",)
        return ()


def _swapped(record: Record, factor: float) -> Record:
    """The record as its spring sees it: the displacement drives, the force, times a factor, answers."""
    return replace(
        record,
        input=record.measured,
        output=factor * record.input[record.scored],
        time=record.time[record.scored],
        history=0,
        columns={},
    )


def linear_oscillator(records: Sequence[Record]) -> tuple[float, float, float]:
    """Mass, damping and stiffness that explain the force's spectrum best where the displacement has its power.

    Where that leaves one of them at 0 or below, or nothing moves, what resonates at the displacement's dominant
    frequency with the stiffness of the spans and a tenth of critical damping.
    """
    rows, targets = [], []
    for record in (_swapped(record, 1.0) for record in records):
        time = np.linspace(record.time[0], record.time[-1], record.time.size)
        taper = np.hanning(time.size)
        X, U = (
            np.fft.rfft(taper * (even - np.mean(even)))
            for even in (np.interp(time, record.time, values) for values in (record.input, record.measured))
        )
        step = float(time[-1] - time[0]) / max(time.size - 1, 1)
        angular = 2.0 * np.pi * np.fft.rfftfreq(time.size, step or 1.0)
        weight = np.abs(X)
        rows.append(np.stack([-(angular**2) * X, 1j * angular * X, X], axis=1) * weight[:, None])
        targets.append(U * weight)
    A, b = np.concatenate(rows), np.concatenate(targets)
    size = np.linalg.norm(A, axis=0)
    if np.all(size > 0.0):
        scaled = A / size
        found = np.linalg.lstsq(
            np.concatenate([scaled.real, scaled.imag]), np.concatenate([b.real, b.imag]), rcond=None
        )
        m, c, k = (float(value) for value in found[0] / size)
        if min(m, c, k) > 0.0:
            return m, c, k
    resonance = 2.0 * np.pi * max(dominant_frequency(_swapped(record, 1.0)) for record in records)
    k = steepness([_swapped(record, 1.0) for record in records])
    return k / resonance**2, 0.2 * k / resonance, k


def _stiff(box: Parameter) -> Parameter:
    """A spring that pushes away has no rest; one that is at first many times as stiff as later, or whose hysteresis is
    over after a hundredth of the way, hardly swings otherwise than a linear one."""
    if box.name in NARROWED:
        low, high = NARROWED[box.name]
        return box.within(low * box.lower, high * box.upper)
    return box.within(0.0, box.upper) if box.name in ("slope", "d", "a0_1") else box
