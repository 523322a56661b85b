"""What the lags, the second-order stage and the sinusoid share: when a time grid asks for new coefficients.

Over a step on which the input is linear, the state of a linear stage changes by coefficients that depend on the step's
duration alone, so that an even grid costs one set of them.
"""

from __future__ import annotations

SAME_STEP = 1e-9
"""Steps of the time grid that differ by less than this share count as equal."""
