"""Write an effect, registered in examples/pyproject.toml, fit with and without it, and find it."""

from dataclasses import dataclass, replace

import numpy as np

from hysteresis_bench import FitOptions, diagnose, fit, measure
from hysteresis_bench.contracts import Effect
from hysteresis_bench.parameters import Parameter


@dataclass(frozen=True)
class PressureSensitivity(Effect):
    """The pressure around the actuator, a further column of the data, moves the output: y + coefficient (p - p_0)."""

    acts = "added"
    family = "change with time, path or temperature"
    parameters = (Parameter("coefficient", -1.0, 1.0, "{output}/kPa", null=0.0),)

    def apply(self, inner, signal, p):
        pressure = signal.columns["pressure"]
        return inner(signal) + p.coefficient * (pressure - pressure[0])[:, None]

    def inapplicable(self, records):
        return "" if all("pressure" in record.columns for record in records) else "no column pressure"


def under_pressure(record):
    """The record with a pressure that wanders, and what that makes of the output."""
    pressure = 101.0 + 0.05 * np.cumsum(np.random.default_rng(len(record.name)).standard_normal(record.time.size))
    return replace(record, output=record.output + 0.2 * (pressure - pressure[0]), columns={"pressure": pressure})


if __name__ == "__main__":
    data = measure("hidden-effects", "slow", "fast", "nested", seed=1).map(under_pressure)
    for effects in ([], ["pressure-sensitivity"]):
        result = fit(data, "bouc-wen", effects, options=FitOptions(seed=1))
        times = result.model.error["fitted"]["rmse"] / data.hidden["noise"]
        print(f"{' and '.join(['bouc-wen', *effects]):34} leaves {times:.3g} times the noise")
    print(diagnose(data, "bouc-wen").headline)  # the diagnosis knows it too
