"""Particles side by side: what a law needs where an equation is solved for the input that acts on it.

A group is one array of rows of LANES, those below and those of who solves the equation, then the law's own. A law is
two functions: one tries an input for the whole group, s[OUT:] where the acting input has moved on from s[Z:] to
s[TRIAL:], and changes no state; a lane that is not OPEN may be left as it is. One makes what the last trial found the
state. Particles that are done try their answer again, and those that pad a group are copies: none knows of another.
"""

from __future__ import annotations

LANES = 8
"""Particles that are solved for side by side; a swarm is padded to a multiple with copies of its last particle."""
GROUPS = 8
"""Groups that take turns, so that one computes while another waits for its own results."""

Z, Y, TRIAL, OUT, OPEN = (row * LANES for row in range(5))
"""What acts and the output before the step; the trial and its output; whether the lane is still sought."""
SOLVER = 5
"""First row of who solves the equation."""
LAW = 19
"""First row of the law."""
