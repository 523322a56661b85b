"""Which optimizers search alike whatever the budget: a trial of any other one, cut short, is none with less."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from hysteresis_bench import registry
from hysteresis_bench.contracts import Optimizer
from hysteresis_bench.report.shared.text import listed
from hysteresis_bench.study.results import Results

SIGN = "†"
"""Behind the name of an optimizer whose schedule needs the budget."""


def anytime(results: Results) -> dict[str, bool | None]:
    """By label, whether the optimizer goes its way without knowing the budget; None where its plugin is not installed
    or broken, so that it cannot be asked."""
    plugins = {label: made.get("plugin", "") for label, made in results.provenance.get("optimizers", {}).items()}
    plugins |= {spec.name: spec.plugin for spec in results.study.optimizer}
    return {label: _of(plugin) for label, plugin in plugins.items()}


def _of(plugin: str) -> bool | None:
    if plugin not in registry.names("optimizers"):
        return None
    loaded = registry.load("optimizers", plugin).loaded
    return loaded.anytime if loaded and issubclass(loaded, Optimizer) else None


def signed(label: str, known: Mapping[str, bool | None]) -> str:
    """The label, with the sign where the schedule needs the budget."""
    return f"{label}\u00a0{SIGN}" if known.get(label) is False else label


def note(labels: Sequence[str], known: Mapping[str, bool | None]) -> str:
    """What the sign says, and of whom nobody knows; empty where neither is among these."""
    unknown = [label for label in labels if label in known and known[label] is None]
    sentences = []
    if any(known.get(label) is False for label in labels):
        sentences.append(
            f"{SIGN} Its schedule is set for the whole budget: with a share of it, it would have searched otherwise. "
            "What stands here below the whole budget, and the area, is the whole run cut short."
        )
    if unknown:
        whose = f"the schedule{'s' * (len(unknown) > 1)} of {listed(unknown, len(unknown))}"
        sentences.append(
            f"Whether {whose} need{'s' * (len(unknown) == 1)} the budget is not known: not installed here."
        )
    return " ".join(sentences)
