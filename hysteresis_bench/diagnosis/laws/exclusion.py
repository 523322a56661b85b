"""Which laws the data exclude before any is fitted, and why a fitted one cannot follow.

A law that runs one way only is excluded by loops that run the other way: no effect around it turns a loop. A law whose
branches must be alike where the data's are not leaves at least half of what they differ by, whatever its parameters.
Where that alone is more than a law may leave to be chosen, and nothing in time blurs the branches (a lag, speeds,
drift), it is excluded as it stands. An effect around it, such as a curve of the output, may bring the same
about: where effects are named, or sought later, or where the law is asked for by its name, it is fitted all the same.
Return-point memory and rate independence exclude nothing, since a lag breaks both, nor does odd symmetry: the centre of
the input and the curve of the output are beside the law. They are told.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from hysteresis_bench import registry
from hysteresis_bench.contracts import Model, Property
from hysteresis_bench.diagnosis.structure.finding import Finding, Name
from hysteresis_bench.diagnosis.structure.structure import Structure
from hysteresis_bench.fit.checks.wanted_units import unlike_wanted
from hysteresis_bench.signals import Record

ASKS: Mapping[Name, Property] = {
    "odd symmetry": "odd",
    "rising and falling branches": "masing",
    "Masing's rule": "masing",
    "return-point memory": "return-point",
    "congruency": "congruent",
    "rate independence": "rate-independent",
}
"""Which property a test asks for."""
EXCLUDES: tuple[Name, ...] = ("Masing's rule", "rising and falling branches", "congruency")
TELLING = 0.2
"""Share of a law's error from which what branches differ by is told as its reason."""
BLURS: tuple[Name, ...] = ("reversal lag", "closure", "rate independence")
"""What, where refuted, may be why branches that are alike seem not to be."""


def excluded(names: Sequence[str], structure: Structure, reachable: float, *, alone: bool) -> dict[str, str]:
    """Why laws are not fitted, by name.

    reachable : RMSE above which no law is chosen, unit of the output
    alone : no effect stands around the laws, nor will
    """
    clear = alone and not any(structure.of(name).refutes for name in BLURS)
    found = {}
    for name in names:
        model: Model = registry.build("models", name, {})
        asked = [structure.of(test) for test in EXCLUDES if clear and ASKS[test] in model.properties]
        reasons = [_wrong_way(model, structure), *(_unlike(finding, reachable) for finding in asked)]
        if reason := next((one for one in reasons if one), ""):
            found[name] = f"excluded: {reason}"
    return found


def unlike_in_unit(names: Sequence[str], records: Sequence[Record]) -> dict[str, str]:
    """Why laws with constants of their own cannot take these records, by name."""
    reasons = {name: unlike_wanted(registry.build("models", name, {}), records) for name in names}
    return {name: f"excluded: {reason}" for name, reason in reasons.items() if reason}


def why_not(name: str, structure: Structure, rmse: float) -> str:
    """Sentences of what the data refute of a law's properties, "" where nothing does that is worth a word beside the
    error. rmse : of the law, unit of the output"""
    model: Model = registry.build("models", name, {})
    asked = [structure.of(test) for test, one in ASKS.items() if one in model.properties]

    def telling(finding: Finding) -> bool:
        return finding.refutes and 0.01 * finding.statistic * structure.span > TELLING * rmse

    mixed = structure.of("sense").words if structure.of("sense").mixed else ""
    told = [
        mixed,
        _wrong_way(model, structure),
        *(finding.words for finding in asked if finding.refutes and telling(finding)),
    ]
    return " ".join(sentence[0].upper() + sentence[1:] for sentence in told if sentence)


def _wrong_way(model: Model, structure: Structure) -> str:
    if structure.side in (0, *model.senses):
        return ""
    only = "anticlockwise" if structure.side < 0 else "clockwise"
    return f"{structure.of('sense').words.removesuffix('.')}; those of this law run {only} only."


def _unlike(finding: Finding, reachable: float) -> str:
    if not finding.refutes or finding.least <= reachable:
        return ""
    return (
        f"{finding.words.removesuffix('.')}. As it stands it would leave {finding.least:.3g} at least, and no law is "
        f"chosen above {reachable:.3g}. An effect around it may change that: name it, or the law."
    )
