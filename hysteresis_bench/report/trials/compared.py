"""A study's optimizers compared: at its budget, at every other one, and whatever their budgets. Once for a report."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import pandas as pd

from hysteresis_bench.report.trials.problem import Problem
from hysteresis_bench.report.trials.summary import other_budgets, problems, summary_of
from hysteresis_bench.study.results import Results


@dataclass(frozen=True, eq=False)
class Compared:
    """here : the problems at the study's budget;  everybody : with the optimizers of every budget;  others : the
    problems at each of the other budgets. Beside them their rows in summary.csv."""

    here: list[Problem]
    summary: pd.DataFrame
    everybody: list[Problem]
    others: list[tuple[list[Problem], pd.DataFrame]]

    @classmethod
    def of(cls, results: Results) -> Self:
        here, budgets = problems(results), other_budgets(results)
        others = [(found := problems(results, budget), summary_of(found, budget)) for budget in budgets]
        everybody = problems(results, any_budget=True) if budgets else here
        return cls(here, summary_of(here, results.study.budget), everybody, others)

    @property
    def rows(self) -> pd.DataFrame:
        """Of summary.csv, all budgets."""
        parts = [self.summary, *(summary for _, summary in self.others)]
        return pd.concat(part for part in parts if not part.empty)
