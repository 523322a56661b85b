"""Which effects do the records ask for, whatever the law? Those that no law does without.

Where the law that was asked about does not follow the records, and no other one comes down to the noise, every effect
may stand in for what is wrong with the law. One without dynamics, such as a curve of the output or a play beside the
law, makes with a rate-independent law just another such law: it cannot be told from the shape of the right one, and is
not named. The others can. One that is needed around each of the laws that leave no more than the asked one makes up for
the fault of none of them; where one of them does without, it may. A law that is not rate-independent is no witness, as
it may hold the effect in itself. Needed is judged as everywhere: by the nested test, by blocks left out, and by an
effect that the noise does not hide.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from hysteresis_bench import registry
from hysteresis_bench.diagnosis.doubt.other_laws import Contender
from hysteresis_bench.diagnosis.hypotheses.systems import is_curve


def is_shape(name: str) -> bool:
    """Has it no dynamics, so that with a rate-independent law it makes another one? What acts inside the state equation
    has some."""
    effect = registry.effect(name)
    return is_curve(effect) or (effect.family == "law" and name not in registry.offered())


def is_rate_independent(law: str) -> bool:
    """Has a registered model, as it is by default, no dynamics of its own?"""
    return "rate-independent" in registry.load("models", law).loaded.properties  # type: ignore[union-attr]


@dataclass(frozen=True)
class Agreement:
    """What is needed around every law that leaves no more than the one that was asked about.

    needs : of the effects in question, what each law needs, by its name; the asked one first, then the best
    left : RMSE of each law with these, on the samples that they were fitted to
    effects : needed around all, and no part of a law's shape; of like ones that which most laws take, with the others
    """

    needs: Mapping[str, tuple[str, ...]]
    left: Mapping[str, float]
    effects: Mapping[str, tuple[str, ...]]

    def without(self, name: str) -> str:
        """Why it may stand in for the law: the best one beside the asked one that needs nothing like it, or none."""
        if is_shape(name):
            return "without dynamics, any law may have the like in its shape"
        others = list(self.needs.items())[1:]
        found = next((law for law, needed in others if not any(alike(name, one) for one in needed)), "")
        return found and f"{found} does without"


def agreement(asked: Contender, others: Sequence[Contender]) -> Agreement:
    """others : laws that leave no more than the asked one; without them only a part of its shape is refused"""
    laws = (asked, *sorted(others, key=lambda one: one.rmse))
    needs = {law.model: law.effects for law in laws}
    left = {law: list(needed) for law, needed in needs.items()}
    effects: dict[str, tuple[str, ...]] = {}
    while shared := _shared(left):
        (name, taken), *_ = shared.items()
        for law, one in taken.items():
            left[law].remove(one)
        effects[name] = tuple(sorted({*taken.values()} - {name}))
    return Agreement(needs, {law.model: law.rmse for law in laws}, effects)


def _shared(left: Mapping[str, Sequence[str]]) -> dict[str, dict[str, str]]:
    """What every law needs, that which most take first: of each law it, or else the first one like it."""
    counts = Counter(name for needed in left.values() for name in needed if not is_shape(name))
    found = {}
    for name in sorted(counts, key=lambda name: (-counts[name], name)):
        taken = {
            law: name if name in needed else next((other for other in needed if alike(name, other)), "")
            for law, needed in left.items()
        }
        if all(taken.values()):
            found[name] = taken
    return found


def alike(one: str, other: str) -> bool:
    """Are they one effect, or do they change the output alike: of one family, or one says that it is mistaken for the
    other? What acts inside the law has nothing in common but the place."""
    first, second = registry.effect(one), registry.effect(other)
    related = other in first.mistaken_for or one in second.mistaken_for
    return one == other or related or (first.family == second.family and first.family != "law")
