"""A model without hysteresis, cheap and with a known optimum."""

from dataclasses import dataclass

from hysteresis_bench.contracts import Model
from hysteresis_bench.parameters import Parameter


@dataclass(frozen=True)
class Polynomial(Model):
    """y = a u + b u^3: no hysteresis, but everything that a meter needs."""

    parameters = (Parameter("a", -2.0, 4.0, "{output}/{input}"), Parameter("b", 0.01, 10.0, scaling="log"))

    def simulate(self, signal, p):
        return p.a * signal.input + p.b * signal.input**3
