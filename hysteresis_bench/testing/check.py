"""The contract tests of one plugin without pytest, each in a process that may hang or die."""

from __future__ import annotations

import inspect
import traceback
from collections.abc import Iterator
from dataclasses import dataclass

from hysteresis_bench import registry
from hysteresis_bench.progress import OnStep, Step, quiet
from hysteresis_bench.study.execution.pool import Pool, Work, at_once
from hysteresis_bench.testing.contract import Broken, promises
from hysteresis_bench.testing.contracts.effects import EffectContract
from hysteresis_bench.testing.contracts.limit import Overrun, within
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
WORK = "the promises, whose kernels are compiled first where they have not been"
TIMED_OUT = "timed-out"
HUNG = 600.0
"""Seconds on top of the limit, for compilation, after which a plugin is killed that waits in compiled code and uses no
processor; one that computes there ends itself by `within`."""
LONGEST = 500
"""Characters that a plugin's own message may take."""


@dataclass(frozen=True)
class Question:
    """One promise of one plugin; method : of the contract, or SPEED;  limit : seconds, compilation not counted"""

    kind: registry.Kind
    plugin: str
    method: str
    limit: float


@dataclass(frozen=True)
class Verdict:
    """What became of a promise. promise : a sentence;  reason : why it is broken, or what the speed is"""

    promise: str
    status: str
    reason: str = ""


def check(kind: registry.Kind, plugin: str, timeout: float, on_step: OnStep = quiet) -> Iterator[Verdict]:
    """Every promise in turn; where all are kept, how fast the plugin is.

    timeout : seconds a promise, beside compilation;  on_step : told where it is
    A plugin that cannot be loaded gets one verdict; one that hangs is asked no more.
    """
    loaded = registry.load(kind, plugin)
    if loaded.fault:
        yield Verdict("It loads, and declares what it must.", BROKEN, loaded.fault)
        return
    asked = promises(CONTRACTS[kind])
    found: dict[str, Verdict] = {}
    on_step(Step(WORK, 0, len(asked)))
    with Pool(Work(at_once(answer), timeout + HUNG), jobs=1) as pool:
        for question, outcome, status, reason in pool.run([Question(kind, plugin, name, timeout) for name in asked]):
            found[question.method] = _judged(asked[question.method], outcome, status, reason)
            on_step(Step(WORK, len(found), len(asked)))
            if status == TIMED_OUT:
                break
        yield from (found[method] for method in asked if method in found)
        if all(verdict.status == KEPT for verdict in found.values()):
            on_step(Step("its speed beside the shipped ones"))
            for _, outcome, status, reason in pool.run([Question(kind, plugin, SPEED, timeout)]):
                yield _judged("Its speed can be measured.", outcome, status, reason)


def _judged(promise: str, outcome: Verdict | None, status: str, reason: str) -> Verdict:
    """What is told of a promise that came to an end, or did not."""
    if status == TIMED_OUT:
        return Verdict(promise, BROKEN, f"{reason}; what had not been tried by then was not.")
    return outcome or Verdict(promise, BROKEN, f"{status}: {reason}.")


def answer(question: Question) -> Verdict:
    """Try one promise in this process."""
    contract = CONTRACTS[question.kind]
    promise = promises(contract).get(question.method, "Speed")
    try:
        with within(question.limit):
            if question.method == SPEED:
                return Verdict(promise, KEPT, speed(question.kind, question.plugin))
            getattr(contract(), question.method)(question.plugin)
    except Overrun:
        return Verdict(promise, TIMED_OUT, f"stopped after {question.limit:g} s, compilation not counted")
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
