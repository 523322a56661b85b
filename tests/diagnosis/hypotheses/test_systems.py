"""Where effects stand in the chain follows from what they declare."""

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.hypotheses.systems import place

CHAIN = [
    "eddy-current",
    "rayleigh-hysteresis",
    "cubic-stiffness",
    "parallel-curve",
    "damping-curve",
    "viscous-damping",
    "inertia",
    "cogging",
    "cogging-wave",
    "backlash",
    "play-bank",
    "asymmetry",
    "input-bias",
    "input-curve",
    "input-dead-zone",
    "input-lag",
    "lag-curve-before",
    "lag-with-level-before",
    "lags-before",
    "modes-before",
    "second-order-input-lag",
    "slew-rate-limit",
    "input-cyclic-error",
    "late-input",
    "output-curve",
    "output-dead-zone",
    "saturation",
    "stop-above",
    "stop-below",
    "clock-error",
    "fatigue",
    "gain-with-path",
    "gain-with-time",
    "response-with-temperature",
    "temperature-sensitivity",
    "thermal-inertia",
    "creep",
    "droop",
    "lag-curve-after",
    "lag-with-level-after",
    "lags-after",
    "modes-after",
    "output-lag",
    "resonance",
    "second-order-lag",
    "transport-delay",
    "output-cyclic-error",
    "disturbance-wave",
    "periodic-disturbance",
    "record-wave",
    "drift",
    "leakage",
    "leakage-curve",
    "zero-with-time",
    "description",
    "bias",
    "record-drift",
    "record-offset",
]
"""Innermost first: what acts on the input, then on the response, then what is added to it, nuisances last."""


def test_the_chain_of_the_shipped_effects():
    shipped = [n for n in registry.names("effects") if registry.load("effects", n).distribution == "hysteresis-bench"]
    inside = [n for n, models in registry.offered().items() if "bouc-wen" in models]
    assert sorted({*shipped, *inside}, key=lambda name: place(name, registry.effect(name))) == CHAIN
