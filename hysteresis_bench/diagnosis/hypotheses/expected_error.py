"""The error to expect on other excitations, from the one on what was left out of a fit.

What is left out is like what is fitted, so that what has more parameters wins it and may yet fail on another
excitation. The error counts the more, the more parameters there are for the blocks that it was judged on, as in
Akaike's final prediction error [1]; `laws.choice` tells how often that is right.

[1] H. Akaike, Ann. Inst. Stat. Math. 21 (1969) 243.
"""

from __future__ import annotations

TIED = 1.02
"""Ratio of two errors at the noise up to which they are equal."""


def weighed(rmse: float, parameters: int, blocks: int) -> float:
    """RMSE to expect of so many parameters, its unit;  rmse : of what was left out, in so many blocks."""
    return rmse * (1.0 + parameters / blocks)
