"""A paper's tables, claims, results, audit and open points, as the TOML file beside a study holds them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

from hysteresis_bench.errors import UserError
from hysteresis_bench.study.strict import Ends, Strict, read_toml, validated
from hysteresis_bench.study.study_file import read_study

Kind = Literal["contradiction", "misprint", "omission", "consequence"]


class Table(Strict):
    """A printed table by columns; `title` as printed.

    controller : which of ours is the paper's own, of a table of tracking errors
    """

    title: str
    controller: str = ""
    columns: dict[str, list[float | str]]


class PublishedResult(Strict):
    """One printed number of one optimizer."""

    optimizer: str
    metric: str
    value: float
    where: str


class Implied(Strict):
    """What a printed metric implies for another one, under assumptions that the paper leaves open.

    arithmetic : an expression of `value` (the printed one) and of the names in `given`
    given : one name and the values that are tried
    """

    of: str
    metric: str
    arithmetic: str
    given: dict[str, list[float]]
    says: str = ""


class Claim(Strict):
    """A sentence of the paper as a comparison: `better` has the lower `metric`, a column of trials.csv or of
    staged-trials.csv, or evaluations_to_success.

    ablation : the question is ours, what a part of the paper's algorithm does for it
    """

    says: str
    where: str
    better: str
    worse: str
    metric: str
    ablation: bool = False


class Audit(Strict):
    """A statement about what is printed, with the arithmetic that bears it out.

    arithmetic : an expression of [values], tables, earlier `name`s and `sample`; empty for a remark on words
    expects, tolerance : what the arithmetic must give (number: to this relative tolerance)
    name : under which later entries know the value
    sample, scaling : boxes from which names are drawn, SAMPLES points uniform on a linear or log scale
    """

    where: str
    printed: str
    says: str
    kind: Kind
    arithmetic: str = ""
    expects: bool | float | None = None
    tolerance: float = 5e-3
    name: str = ""
    sample: dict[str, Ends] = {}
    scaling: Literal["linear", "log"] = "linear"


class Decision(Strict):
    """What the paper leaves open, and what is done here."""

    where: str
    open: str
    decided: str


class Published(Strict):
    """A published file. `comparable` names the metrics that may be set side by side with ours, and `because`
    says why only those; `iterations` is the paper's number of iterations after the first swarm."""

    citation: str = ""
    because: str = ""
    comparable: list[str] = []
    iterations: int | None = None
    values: dict[str, float | list[float]] = {}
    tables: dict[str, Table] = {}
    result: list[PublishedResult] = []
    implied: list[Implied] = []
    claim: list[Claim] = []
    audit: list[Audit] = []
    decision: list[Decision] = []

    @property
    def optimizers(self) -> list[str]:
        """The optimizers the paper speaks of, in order of appearance."""
        claims = [claim for claim in self.claim if not claim.ablation]
        named = [name for claim in claims for name in (claim.worse, claim.better)]
        return list(dict.fromkeys([result.optimizer for result in self.result] + named))


def check_published(raw: Mapping[str, Any], where: str = "published.toml") -> Published:
    """Parsed TOML -> a checked file; an empty one without a paper. Raises UserError naming every fault."""
    published, _, faults = validated(Published, raw)
    if published is None:
        raise UserError(where, faults)
    return published


def check_published_beside(study: Path) -> None:
    """Check the published file that a study names, before an hour of trials. Raises UserError."""
    named = read_study(study)[0].published
    if named and (file := study.parent / named).is_file():
        check_published(read_toml(file)[0], str(file))
