"""The contract tests of one plugin without pytest, each in a process that may hang or die."""

from __future__ import annotations

import inspect
import traceback
from collections.abc import Iterator
from dataclasses import dataclass

from hysteresis_bench import registry
from hysteresis_bench.study.execution.pool import Pool, Work, at_once
from hysteresis_bench.testing.contracts.contract import Broken, promises
from hysteresis_bench.testing.contracts.effects import EffectContract
from hysteresis_bench.testing.contracts.models import ModelContract
from hysteresis_bench.testing.contracts.optimizers import OptimizerContract
from hysteresis_bench.testing.contracts.rigs import RigContract
from hysteresis_bench.testing.plugin import PluginContract
from hysteresis_bench.testing.speed import speed

CONTRACTS: dict[registry.Kind, type[PluginContract]] = {
    "models": ModelContract,
    "effects": EffectContract,
    "optimizers": OptimizerContract,
    "rigs": RigContract,
}
KEPT, BROKEN = "kept", "broken"
SPEED = "speed"
TIMED_OUT = "timed-out"
LONGEST = 500
"""Characters that a plugin's own message may take."""


@dataclass(frozen=True)
class Question:
    """One promise of one plugin; method : of the contract, or SPEED."""

    kind: registry.Kind
    plugin: str
    method: str


@dataclass(frozen=True)
class Verdict:
    """What became of a promise. promise : a sentence;  reason : why it is broken, or what the speed is"""

    promise: str
    status: str
    reason: str = ""


def check(kind: registry.Kind, plugin: str, timeout: float) -> Iterator[Verdict]:
    """Every promise in turn; where all are kept, how fast the plugin is. timeout : seconds a promise

    A plugin that cannot be loaded gets one verdict; one that hangs is asked no more.
    """
    loaded = registry.load(kind, plugin)
    if loaded.fault:
        yield Verdict("It loads, and declares what it must.", BROKEN, loaded.fault)
        return
    asked = promises(CONTRACTS[kind])
    found: dict[str, Verdict] = {}
    with Pool(Work(at_once(answer), timeout), jobs=1) as pool:
        for question, outcome, status, reason in pool.run([Question(kind, plugin, method) for method in asked]):
            promise = asked[question.method]
            found[question.method] = outcome or Verdict(promise, BROKEN, f"{status}: {reason}.")
            if status == TIMED_OUT:
                found[question.method] = Verdict(promise, BROKEN, f"{reason}; what had not been tried by then was not.")
                break
        yield from (found[method] for method in asked if method in found)
        if all(verdict.status == KEPT for verdict in found.values()):
            for _, outcome, status, reason in pool.run([Question(kind, plugin, SPEED)]):
                yield outcome or Verdict("Its speed can be measured.", BROKEN, f"{status}: {reason}.")


def answer(question: Question) -> Verdict:
    """Try one promise in this process."""
    if question.method == SPEED:
        return Verdict("Speed", KEPT, speed(question.kind, question.plugin))
    contract = CONTRACTS[question.kind]
    promise = promises(contract)[question.method]
    try:
        getattr(contract(), question.method)(question.plugin)
    except Broken as broken:
        return Verdict(promise, BROKEN, _cut(str(broken)))
    except BaseException as error:  # whatever the plugin raises is its answer, sys.exit too
        return Verdict(promise, BROKEN, _cut(f"{type(error).__name__}: {error}{_where(error, question)}"))
    return Verdict(promise, KEPT)


def _where(error: BaseException, question: Question) -> str:
    """File and line of the plugin in which an exception was raised, or nothing."""
    loaded = registry.load(question.kind, question.plugin).loaded
    source = inspect.getsourcefile(loaded) if loaded else None
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == source]
    return f" ({source}, line {lines[-1]})" if lines else ""


def _cut(text: str) -> str:
    told = " ".join(text.split())
    return told if len(told) <= LONGEST else f"{told[:LONGEST]} ..."
