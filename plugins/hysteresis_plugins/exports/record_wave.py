"""A hum whose phase is estimated where an output was measured: without one there is none."""

from __future__ import annotations

from hysteresis_plugins.exports.record_drift import part as part
