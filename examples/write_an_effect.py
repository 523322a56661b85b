"""Write an effect, registered in examples/pyproject.toml, fit with and without it, and find it."""

from dataclasses import dataclass, replace

from scipy.integrate import cumulative_trapezoid

from hysteresis_bench import FitOptions, diagnose, fit, measure
from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter


def charge(time, voltage):
    """The integral of the voltage over time from the first sample, (samples, swarm) like the voltage."""
    return cumulative_trapezoid(voltage, time, axis=0, initial=0.0)


@dataclass(frozen=True)
class Leakage(Effect):
    """A conducting path beside the actuator: y + conductance ∫ u dt, as in charge measurements."""

    acts = "added"
    family = "added disturbance"
    parameters = (Parameter("conductance", -1.0, 1.0, "{output}/{input}/{time}", null=0.0),)

    def apply(self, inner, signal, p):
        return inner(signal) + p.conductance * charge(signal.time, signal.input)


if __name__ == "__main__":
    data = measure("hidden-effects", "slow", "fast", "nested", seed=1)
    data = data.map(lambda record: replace(record, output=record.output + 0.3 * charge(record.time, record.input)))
    for effects in ([], ["leakage"]):
        result = fit(data, "bouc-wen", effects, options=FitOptions(budget=4000, seed=1))
        times = result.model.error["fitted"]["rmse"] / data.hidden["noise"]
        print(f"{' and '.join(['bouc-wen', *effects]):24} leaves {times:.3g} times the noise")
    print(diagnose(data, "bouc-wen").headline)  # the diagnosis knows it too
