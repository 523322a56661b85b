"""What an experiment settled that was carried out: the ties before it, and what became of them."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from hysteresis_bench.fit.identifiability.combinations import listed
from hysteresis_bench.signals import Record


@dataclass(frozen=True)
class Tied:
    """Effects of which the records before could not tell which one it is.

    names : the adopted one first
    probability : with which the experiment was expected to tell it from any of the others; None where it was not made
    for that
    left : afterwards, each of them that is claimed, with those of the others that are tied with it
    """

    names: tuple[str, ...]
    probability: float | None
    left: tuple[tuple[str, ...], ...]

    @property
    def settled(self) -> bool:
        """One of them is claimed, and tied with none of the others."""
        return len(self.left) == 1 and len(self.left[0]) == 1

    @property
    def open(self) -> bool:
        """All of them are tied still."""
        return len(self.left) == 1 and {*self.left[0]} == {*self.names}

    @property
    def words(self) -> str:
        """What became of them, as a clause."""
        if self.open:
            return "the records with it cannot tell either"
        if not self.left:
            return "none of them is claimed any more"
        claimed = [_either(names) for names in self.left]
        return f"it is {claimed[0]}" if len(claimed) == 1 else f"claimed are {listed(claimed)}"


@dataclass(frozen=True)
class Measured:
    """An experiment that was advised and carried out.

    bench : on which;  experiment : in words;  record : what came of it
    headline, effects : of the diagnosis before;  ties : before, with what became of them
    notes : what was odd about the measurement, a sentence each
    """

    bench: str
    experiment: str
    record: Record
    headline: str
    effects: tuple[str, ...]
    ties: tuple[Tied, ...]
    notes: tuple[str, ...]

    @property
    def words(self) -> str:
        """What was measured and what it settled, as sentences."""
        samples = self.record.time.size
        became = "; ".join(f"{_either(tied.names)}: {tied.words}" for tied in self.ties)
        return (
            f"The advised experiment was carried out on {self.bench}: {self.experiment} ({samples} samples, record "
            f"{self.record.name}). Tied before were {became}."
        )

    def as_dict(self) -> dict[str, Any]:
        """The part of diagnosis.json."""
        ties = [{**asdict(tied), "settled": tied.settled, "words": tied.words} for tied in self.ties]
        return {
            "bench": self.bench,
            "signal": self.experiment,
            "record": self.record.name,
            "samples": self.record.time.size,
            "before": {"headline": self.headline, "effects": list(self.effects)},
            "ties": ties,
            "words": self.words,
            "notes": list(self.notes),
        }


def _either(names: tuple[str, ...]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} or {names[-1]}"
