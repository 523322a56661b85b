"""Does every record drift in its own way, as a fluxmeter or a charge amplifier does between two resets?

The output then begins a loop elsewhere than it ends the one before, as a device does that remembers what came before
its record. A straight line in time for each record tells the two apart: beside the law, or what was found around it, it
comes down to the noise in all samples, the beginnings among them.
"""

from __future__ import annotations

from hysteresis_bench.diagnosis.laws.surroundings import drifts
from hysteresis_bench.diagnosis.search.search import Found
from hysteresis_bench.diagnosis.search.selection import REACHED

DRIFTS = (
    "Every record drifts in its own way: with {} beside the law all samples are followed down to the noise. It is a "
    "part of the model here, as if --effect had asked for it; of a record whose output is not known it knows nothing."
)


def drift_of_each(found: Found) -> str:
    """The effect that takes each record's own drift off, where it comes down to the noise; else ""."""
    stack = found.thin.stack
    asked = [(one, name) for name in drifts(stack) if name not in stack.own for one in (found.base, found.best)]
    for system, name in asked:
        if found.thin.extended(system, name).rmse <= REACHED * found.selection.floor:
            return name
    return ""
