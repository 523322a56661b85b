"""A second-order lag after the hysteresis; constants: damping, stiffness."""

from __future__ import annotations

from hysteresis_plugins.exports.resonance import after as after
from hysteresis_plugins.exports.second_order_input_lag import part as part
