"""The heater voltage by which the shape memory alloy rig's reading follows a wanted temperature, as far as it can."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_plugins.rigs._sma_mechanics import Physics

PASSES = 12
"""The first is a balance of heat without the wire's phases; each of the others takes the error of the one before into
the balance, as in iterative learning control (S. Arimoto et al., J. Robotic Systems 1 (1984) 123)."""


def voltage_for(time: Array, wanted: Array, read: Callable[[Array], Array], highest: float, k: Physics) -> Array:
    """time : (samples,) s, evenly spaced;  wanted : (samples,) degC;  read(voltage) -> (samples,) degC, without noise
    highest : voltage, V. The heater only heats: cooling is left to the air."""
    capacity = k.jacket_heat_capacity + k.wire_heat_capacity

    def balance(temperature: Array) -> Array:
        """Power for it, W/m, above the ambient's."""
        return capacity * np.gradient(temperature, time) + k.convection * temperature

    power, best, least = balance(wanted - k.ambient), np.zeros(time.size), np.inf
    for _ in range(PASSES):
        power = np.clip(power, 0.0, highest**2 / k.resistance)
        voltage = np.sqrt(power * k.resistance)
        missed = wanted - read(voltage)
        if (rms := float(np.sqrt(np.mean(missed**2)))) < least:
            best, least = voltage, rms
        power = power + balance(missed)
    return best
