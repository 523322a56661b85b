"""The giant magnetostrictive actuator: free-energy magnetization, quadratic strain, rod dynamics.

Chang G., Zhang Y., Parameter Identification of GMA Nonlinear Dynamics Model Based on ICPSO,
equations (1) to (5) and (19).

| symbol | name           | meaning                                | value                      |
|--------|----------------|----------------------------------------|----------------------------|
| n      | turns          | coil turns a metre                     | 14400 /m, printed          |
| A_r    | area           | cross-section of the rod               | 7.85e-5 m^2, printed       |
| M      | mass           | rod and load                           | 0.5 kg, printed            |
| C      | damping        | rod and load                           | 4.325e3 N s/m, printed     |
| K      | stiffness      | rod and load                           | 3.375e7 N/m, printed       |
| E^H    | modulus        | Young's modulus at constant field      | 30 GPa, ours               |
| G      | disturbance    | what acts on M in (5)                  | 0 N/kg, ours               |
| σ      | prestress      | compression in (5)                     | 0 Pa, ours                 |
| λ_s    | lambda_s       | saturation magnetostriction            | found                      |
| M_s    | M_s            | saturation magnetization               | found                      |
| M_R, η, H̄_c, b, c, α | as in free_energy.py                    | found                      |

E^H is not printed; Terfenol-D has 25 to 35 GPa. λ_s, M_s and α act only in λ_s (α M_R)^2 / M_s^2, and M_R
and η besides only as their product: five combinations of the eight can be found. REDUCED fixes the rest.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any, ClassVar, Literal

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Effect, Model
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.effects._ranges import FINEST, dominant_frequency, finest_step
from hysteresis_plugins.models._eddy_current import EddyCurrent
from hysteresis_plugins.models.free_energy import FreeEnergy, unswitched

REDUCED = {"lambda_s": 1.0e-3, "M_s": 7.65e5, "alpha": 2.0e-9}
"""What may be fixed so that the other five can be found. λ_s and M_s of Terfenol-D as in Dapino, Smith,
Flatau, IEEE Trans. Magnetics 36 (2000) 545; α such that the densities' mass is of the order of 1."""

LEAST_COERCIVE = 200.0
"""A/m; the softest material that the box allows. A smaller field switches next to nothing."""

SUSCEPTIBILITY = (1.0, 100.0)
"""dM/dH of rods, hard and soft; Terfenol-D has some 2 to 10 (Engdahl, Handbook of Giant Magnetostrictive Materials,
2000)."""


@dataclass(frozen=True)
class RodEddyCurrent(EddyCurrent):
    """Eddy currents in the rod: the field H - coefficient dM/dt magnetizes it, as `EddyCurrent` says of any law.

    In a rod of radius R and conductivity σ that the field penetrates, the coefficient is μ0 σ R²/8 [1]; it is known
    only as well as the magnetization's scale, which M_s, λ_s and α set together.

    [1] G. Bertotti, Hysteresis in Magnetism, Academic Press (1998), section 12.1: the classical loss of a cylinder.
    """

    parameters = (
        Parameter("coefficient", 1e-9, 1.0, "s", "log", null=0.0, meaning="drag on the magnetization's rate"),
    )

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """Where the rod lags by a fiftieth of a sampling step to a period of the slowest record's input."""
        least, most = SUSCEPTIBILITY
        period = max(1.0 / dominant_frequency(record) for record in records)
        return (self.parameters[0].within(FINEST * finest_step(records) / most, period / least),)


@dataclass(frozen=True)
class FreeEnergyGma(Model):
    """Giant magnetostrictive actuator: a current in A to a displacement in micrometres, by free-energy hysteresis.

    The box is ours (the paper prints none): λ_s and M_s around Terfenol-D's, the others in decades about
    values for which a field of some 10 kA/m saturates the rod; `box` scales the fields to the data.

    turns, area, mass, damping, stiffness, modulus, disturbance, prestress : see the module's legend
    bias_field : A/m, added to the coil's; where it is None, the record's column "bias_field", or else 0
    rule, nodes, span : of the quadrature, see `free-energy`

    Where the time is only an index, the rod follows at once. Raises ValueError where H_c, b, c, eta or M_s
    is not above 0.
    """

    parameters = (
        Parameter("lambda_s", 3e-4, 3e-3, "1", "log", meaning="saturation magnetostriction"),
        Parameter("M_s", 3e5, 1.5e6, "A/m", "log", meaning="saturation magnetization", positive=True),
        Parameter("M_R", 1e4, 5e6, "A/m", "log", meaning="remanence of a kernel"),
        Parameter("eta", 0.01, 100.0, "1", "log", meaning="slope of a kernel, dH/dM", positive=True),
        Parameter("H_c", LEAST_COERCIVE, 5e4, "A/m", "log", meaning="mean coercive field", positive=True),
        Parameter("b", 1e3, 2e5, "A/m", "log", meaning="width of the interaction field's density", positive=True),
        Parameter(
            "c", 0.02, 1.5, "1", "log", meaning="width of the coercive field's density, in ln H_c", positive=True
        ),
        Parameter("alpha", 1e-10, 1e-7, "m^2/A^2", "log", meaning="scale of the densities"),
    )
    offers: ClassVar[Mapping[str, Effect]] = MappingProxyType({"eddy-current": RodEddyCurrent()})
    wants = MappingProxyType({"time": "s", "input": "A", "output": "um", "bias_field": "A/m"})

    turns: float = 14400.0
    area: float = 7.85e-5
    mass: float = 0.5
    damping: float = 4.325e3
    stiffness: float = 3.375e7
    modulus: float = 30e9
    disturbance: float = 0.0
    prestress: float = 0.0
    bias_field: float | None = None
    rule: Literal["trapezoid", "gauss-legendre", "gauss-hermite"] = "trapezoid"
    nodes: int = 64
    span: float = 3.0

    def __post_init__(self) -> None:
        for name in ("turns", "area", "mass", "stiffness", "modulus"):
            if getattr(self, name) <= 0.0:
                raise ValueError(f"{name} = {getattr(self, name)} must be above 0")

    @cached_property
    def _magnetization(self) -> FreeEnergy:
        return FreeEnergy(self.rule, self.nodes, self.span)

    def simulate(self, signal: Signal, p: Any) -> Array:
        if not np.min(p.M_s) > 0.0:
            raise ValueError(f"free-energy-gma: M_s must be above 0, not {np.min(p.M_s):g}")
        magnetized = self._magnetization.simulate(signal.with_input(self.field(signal)), p)  # (1)
        strain = 1.5 * p.lambda_s * (magnetized / p.M_s) ** 2  # (4)
        force = self.area * self.modulus * strain + self.mass * self.disturbance - self.prestress * self.area
        return 1e6 * self._displacement(signal, force)

    def field(self, signal: Signal) -> Array:
        """Field in the rod, A/m: the coil's and the bias; the shape of the input."""
        bias = self.bias_field
        if bias is not None or "bias_field" not in signal.columns:
            return self.turns * signal.input + (bias or 0.0)
        return self.turns * signal.input + signal.columns["bias_field"][:, None]

    def _displacement(self, signal: Signal, force: Array) -> Array:
        """(5): (samples, swarm) in m; force in N."""
        deflection = force / self.stiffness
        if not signal.timed:
            return deflection
        from hysteresis_bench.kernels.second_order import second_order

        one = np.ones(force.shape[1])
        return second_order(signal.time, deflection, one * self.damping / self.mass, one * self.stiffness / self.mass)

    def box(self, records: Sequence[Record]) -> tuple[Parameter, ...]:
        """The box with the fields H_c and b, and α with them, scaled to the field of the records."""
        reach = max(float(np.max(np.abs(self.field(record.signal)))) for record in records) or 1.0
        scales = {"H_c": reach / 1e5, "b": reach / 1e5, "alpha": (reach / 1e5) ** -2}
        return tuple(
            q.within(q.lower * scales.get(q.name, 1.0), q.upper * scales.get(q.name, 1.0)) for q in self.parameters
        )

    def advice(self, records: Sequence[Record]) -> tuple[str, ...]:
        sentences: list[str] = []
        for record in records:
            applied = self.field(record.signal)[:, 0]
            sentences += unswitched(record.name, applied)
            reach, least = float(np.max(np.abs(applied))), LEAST_COERCIVE
            if reach < least:
                sentences.append(
                    f"record {record.name}: the field stays below {reach:.3g} A/m and never reaches the switching "
                    f"range, which begins at some {least:g} A/m; there is nothing to identify. Is the input in A?"
                )
            biased = np.any(applied != self.turns * record.input)
            if not biased and np.min(record.input) < 0.0 < np.max(record.input):
                sentences.append(
                    f"record {record.name}: without a bias field the displacement has twice the current's "
                    f"frequency; where the actuator is biased, set bias_field."
                )
            rest = 1e6 * (self.mass * self.disturbance - self.prestress * self.area) / self.stiffness
            if record.output is not None and np.max(record.measured) < rest:
                sentences.append(
                    f"record {record.name}: all displacements are below {rest:g} um, where the model's are all "
                    f"above it; flip the output or add an offset."
                )
        return tuple(sentences)
