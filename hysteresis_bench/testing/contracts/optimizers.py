"""What every optimizer promises: the exact budget, the box, its seed, and an end on any landscape."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Model
from hysteresis_bench.fit.objective import OutsideBox
from hysteresis_bench.testing.contract import Broken, expect
from hysteresis_bench.testing.examples import Breaks, Plateau, Waves
from hysteresis_bench.testing.meter import Search, watch
from hysteresis_bench.testing.plugin import PluginContract


class OptimizerContract(PluginContract):
    """Subclass it in a test file and name the plugin: `plugin = "my-search"`."""

    kind = "optimizers"

    def use(self, built: Any) -> Sequence[Array]:
        search = watch(built, Waves(3), 120)
        return search.points, search.trace.evaluations, search.trace.losses, search.trace.points

    def search(self, plugin: str, model: Model, budget: int, seed: int = 0) -> Search:
        """A watched search. Raises Broken where the budget or the box is not kept."""
        try:
            found = watch(self.build(plugin), model, budget, seed)
        except OutsideBox as error:
            raise Broken(f"it proposes a point outside the unit box: {error}.") from error
        scored = found.points.shape[1]
        where = f"with a budget of {budget} evaluations in {len(model.parameters)} dimensions"
        expect(found.evaluations == scored, f"{where} it sets the meter's count to {found.evaluations} of {scored}.")
        expect(scored <= budget, f"{where} it has {scored} points scored.")
        expect(scored > 0, f"{where} it evaluates nothing.")
        expect(
            found.refusals == found.spent,
            f"{where} it catches BudgetSpent and goes on; let it through (it is no Exception on purpose).",
        )
        expect(scored == budget or not found.spent, f"{where} it ends by BudgetSpent after {scored}.")
        return found

    def test_it_keeps_its_budget(self, plugin: str) -> None:
        """It spends its budget exactly, or returns early; the refusal of the next evaluation ends it."""
        for budget in (1, 7, 60, 517):
            self.search(plugin, Waves(5), budget)

    def test_it_stays_in_the_box(self, plugin: str) -> None:
        """Every point lies in the unit box, and is a number."""
        points = self.search(plugin, Waves(5), 517).points
        outside = points[~((points >= 0.0) & (points <= 1.0))]
        expect(not outside.size, f"it proposes coordinates outside [0, 1], such as {outside[:1]}.")

    def test_it_works_in_few_dimensions(self, plugin: str) -> None:
        """In one dimension and in two it finds something better than its first point."""
        for dimension in (1, 2):
            trace = self.search(plugin, Waves(dimension), 150).trace
            where = "in one dimension" if dimension == 1 else "in two dimensions"
            expect(trace.losses[-1] < trace.losses[0], f"{where} it finds nothing better than its first point.")

    def test_its_random_numbers_come_from_the_seed(self, plugin: str) -> None:
        """The same seed gives the same points in the same order, also on a longer search."""
        first, again = (self.search(plugin, Waves(5), 517) for _ in range(2))
        same = np.array_equal(first.points, again.points) and np.array_equal(first.trace.losses, again.trace.losses)
        expect(same, "the same seed gives another search; draw every random number from the generator `rng`.")

    def test_it_ends_on_a_plateau(self, plugin: str) -> None:
        """It ends where every loss is the same, also where each is the ceiling that answers NaN."""
        for level in (3.0, np.nan):
            found = self.search(plugin, Plateau(3, level), 400)
            expect(found.trace.losses.size == 1, "the trace of a plateau has more than one entry.")

    def test_a_fault_of_the_model_comes_through(self, plugin: str) -> None:
        """An exception that a model raises ends the search, and can be read."""
        try:
            watch(self.build(plugin), Breaks(2), 200)
        except Exception as error:  # whatever the optimizer's library makes of it
            told = f"{error} {error.__cause__} {error.__context__}"
            expect("the model broke" in told, f"of a fault in the model it tells only: {type(error).__name__}: {error}")
        else:
            raise Broken("it swallows the exception that a model raises; catch none that you did not raise.")

    def test_its_iterations_cost_what_it_says(self, plugin: str) -> None:
        """`evaluations_per_iteration` answers None or a whole number of at least 1."""
        cost = self.build(plugin).evaluations_per_iteration(5)
        expect(
            cost is None or (isinstance(cost, int) and cost >= 1), f"an iteration costs {cost!r}, no number of points."
        )
