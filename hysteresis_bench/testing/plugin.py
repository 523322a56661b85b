"""What every plugin promises, whatever its kind."""

from __future__ import annotations

import contextlib
import dataclasses
import io
from collections.abc import Sequence
from typing import Any

import numpy as np

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.testing.contract import Contract, expect
from hysteresis_bench.testing.process import undisturbed


class PluginContract(Contract):
    """Of every kind; a kind's own contract says by `use` what a plugin of it is asked."""

    def use(self, built: Any) -> Sequence[Array]:
        """All that the plugin answers to a fixed set of questions."""
        raise NotImplementedError

    def build(self, plugin: str) -> Any:
        """The plugin with its default settings. Raises Broken where it cannot be built."""
        faults = registry.faults(self.kind, plugin, {})
        expect(not faults, " · ".join(faults))
        return registry.build(self.kind, plugin)

    def test_it_loads(self, plugin: str) -> None:
        """It loads, declares what it must, and its docstring begins with a sentence."""
        self.build(plugin)
        loaded = registry.load(self.kind, plugin)
        expect(loaded.summary.endswith("."), f"the first paragraph of its docstring is no sentence: {loaded.summary!r}")

    def test_its_settings_stay(self, plugin: str) -> None:
        """Its settings are frozen, and using it leaves them as they are."""
        built = self.build(plugin)
        expect(type(built).__dataclass_params__.frozen, f"{type(built).__name__} is a @dataclass without frozen=True.")
        before = _settings(built)
        self.use(built)
        changed = [name for name, value in _settings(built).items() if before[name] != value]
        expect(not changed, f"using it changes its settings {', '.join(changed)}.")

    def test_it_answers_the_same_again(self, plugin: str) -> None:
        """The same question and seed get the same answer to the last bit, whatever was asked before."""
        built = self.build(plugin)
        answers = []
        for seed, asked in ((1, built), (2, built), (3, self.build(plugin))):
            with contextlib.suppress(AssertionError), undisturbed(seed):  # disturbing is another promise
                answers.append(self.use(asked))
        first, again, anew = answers
        expect(_same(first, again), "a second use answers otherwise: it keeps a state or uses global random numbers.")
        expect(_same(first, anew), "a second instance answers otherwise: something outlives the first.")

    def test_it_leaves_its_process_alone(self, plugin: str) -> None:
        """It leaves global random numbers, numpy's settings, warnings, environment and threads as they were."""
        built = self.build(plugin)
        with contextlib.suppress(AssertionError), undisturbed(0):
            self.use(built)  # libraries may set things up once, when they are imported
        with undisturbed(4):
            self.use(built)

    def test_it_prints_nothing(self, plugin: str) -> None:
        """It prints nothing."""
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            self.use(self.build(plugin))
        expect(not printed.getvalue(), f"it prints {printed.getvalue()[:60]!r}; plugins say nothing.")


def shipped(kind: registry.Kind) -> tuple[str, ...]:
    """Names of the plugins that come with this package."""
    own = registry.load("optimizers", registry.SEARCH).distribution
    plugins = (registry.load(kind, name) for name in registry.names(kind))
    return tuple(plugin.name for plugin in plugins if plugin.distribution == own and not plugin.fault)


def _settings(built: Any) -> dict[str, str]:
    return {field.name: repr(getattr(built, field.name)) for field in dataclasses.fields(built)}


def _same(one: Sequence[Array], other: Sequence[Array]) -> bool:
    pairs = zip(one, other, strict=False)
    return len(one) == len(other) and all(np.array_equal(*pair, equal_nan=True) for pair in pairs)
