"""Effects that break one promise each."""

from dataclasses import dataclass

import numpy as np

from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter

BEND = Parameter("bend", -0.2, 0.2, "1/{output}", null=0.0, meaning="of the output")


class Bends(Effect):
    """y + bend y²; the others change one thing in it."""

    acts = "output"
    family = "curve of the output"
    parameters = (BEND,)

    def apply(self, inner, signal, p):
        y = inner(signal)
        return y + p.bend * y**2

    def box(self, records):
        steepest = 0.4 / max(float(np.max(np.abs(record.measured))) for record in records)
        return (self.parameters[0].within(-steepest, steepest),)


@dataclass(frozen=True)
class NotNeutral(Bends):
    """Is nearly neutral at its null."""

    def apply(self, inner, signal, p):
        return super().apply(inner, signal, p) * (1.0 + 1e-15) + 1e-18


@dataclass(frozen=True)
class NoNull(Bends):
    """Cannot be switched off."""

    parameters = (Parameter("bend", -0.2, 0.2, "1/{output}", meaning="of the output"),)


@dataclass(frozen=True)
class OtherUnit(Bends):
    """Says another unit than it has."""

    parameters = (Parameter("bend", -0.2, 0.2, "1/{input}", null=0.0, meaning="of the output"),)


@dataclass(frozen=True)
class Sampled(Bends):
    """Counts samples."""

    def apply(self, inner, signal, p):
        return inner(signal) + p.bend * np.linspace(0.0, 1.0, signal.time.size)[:, None] * (signal.time.size / 241)


@dataclass(frozen=True)
class Jumps(Bends):
    """Is on or off."""

    def apply(self, inner, signal, p):
        y = inner(signal)
        return y + np.sign(p.bend) * 0.1 * y**2


@dataclass(frozen=True)
class Overwrites(Bends):
    """Works in place on the input."""

    acts = "input"

    def apply(self, inner, signal, p):
        signal.input[:] = 0.0
        return inner(signal)


@dataclass(frozen=True)
class HidesNothing(Bends):
    """Its hidden form changes nothing."""

    hidden_forms = (lambda inner, u, hiding: inner(u),)


@dataclass(frozen=True)
class Mistaken(Bends):
    """May be mistaken for what is not there."""

    mistaken_for = {"asymmetri": "both bend"}  # noqa: RUF012


@dataclass(frozen=True)
class Nowhere(Bends):
    """Acts nowhere that is known."""

    acts = "outside"
