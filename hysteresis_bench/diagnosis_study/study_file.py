"""A study of diagnosis as a TOML file: benches, each a rig and what is hidden in it; all faults are told at once."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, NonNegativeInt, PositiveInt

from hysteresis_bench import registry
from hysteresis_bench.contracts import DrivenRig
from hysteresis_bench.errors import UserError, nearest
from hysteresis_bench.study.strict import Seconds, Strict, listed, read_toml, table, tables, validated
from hysteresis_bench.study.study_faults import doubles, problem_faults

OF_THE_RIG = "of the rig"


def _unless_of_the_rig(value: Any) -> Any:
    return None if value == OF_THE_RIG else value


class BenchSpec(Strict):
    """One bench: a rig, what is hidden in it, and what the diagnosis gets to see.

    hidden : names that count as right, one entry for each effect that is switched on; "a|b" where either name says
        it. Without it, or with "of the rig", the names are what the rig itself says is hidden
    vary : the rig's setting that takes the number of the case; seeds alone differ where it is empty
    fresh : experiments that are neither fitted nor held out, for the error at the end
    measure : where effects are tied, the advised experiment is carried out and what it settles is counted; that costs
        another diagnosis
    share : cases of this bench for each of the study's trials
    first : number of the first case: what a case hides goes by its number, and lower ones may have been used before
    """

    name: str
    rig: str
    settings: dict[str, Any] = {}
    hidden: Annotated[list[str] | None, BeforeValidator(_unless_of_the_rig)] = None
    vary: str = ""
    model: str
    fitted: list[str] = Field(min_length=1)
    held_out: list[str] = Field(min_length=1)
    fresh: list[str] = []
    measure: bool = False
    share: PositiveInt = 1
    first: NonNegativeInt = 0

    def numbers(self, trials: int) -> range:
        """Which cases are made, by number: so many trials, of this share of the study."""
        return range(self.first, self.first + trials * self.share)


class DiagnosisStudy(Strict):
    """A checked study of diagnosis."""

    kind: Literal["diagnosis"]
    title: str
    seed: int
    trials: PositiveInt = 1
    timeout: Seconds = 900.0
    notes: list[str] = []
    bench: list[BenchSpec] = Field(min_length=1)


def is_diagnosis_study(path: Path) -> bool:
    """Does the file name a kind of study? A file that cannot be read is left to whoever reads it next."""
    try:
        return "kind" in read_toml(path)[0]
    except UserError:
        return False


def read_diagnosis_study(path: Path) -> tuple[DiagnosisStudy, str]:
    """A study and its text. Raises UserError telling every fault of the file, of form and of content."""
    raw, text = read_toml(path)
    study, sound, faults = validated(DiagnosisStudy, raw)
    benches = tables(sound, "bench")
    for number, bench in enumerate(benches, 1):
        faults += [f"[[bench]] {number}: {fault}" for fault in _bench_faults(bench)]
    faults += doubles("bench", [str(bench["name"]) for bench in benches if "name" in bench])
    if study is None or faults:
        raise UserError(str(path), faults)
    return study, text


def _bench_faults(bench: dict[str, Any]) -> list[str]:
    """What a bench names that does not exist: rig, settings, experiments, model, hidden effects."""
    settings = table(bench, "settings")
    if bench.get("vary"):
        settings = {**settings, str(bench["vary"]): 0}
    keys = ("fitted", "held_out", "fresh")
    asked = {key: bench[key] for key in ("rig", "model", *keys) if key in bench}
    effects = (*registry.names("effects"), *registry.offered())
    hidden = [name for entry in listed(bench, "hidden") for name in entry.split("|")]
    return [
        *problem_faults({**asked, "rig_settings": settings}, keys),
        *(_driven_faults(str(bench.get("rig"))) if bench.get("measure") is True else []),
        *(f'hidden: no effect "{name}". {nearest(name, effects)}' for name in hidden if name not in effects),
    ]


def _driven_faults(rig: str) -> list[str]:
    """Whether the rig plays drives; one that is unknown is told elsewhere."""
    loaded = registry.load("rigs", rig).loaded if rig in registry.names("rigs") else None
    return [] if loaded is None or issubclass(loaded, DrivenRig) else [f"measure: {no_drive(rig)}"]


def no_drive(rig: str) -> str:
    """The sentence on a rig that plays no drive."""
    loaded = {each: registry.load("rigs", each).loaded for each in registry.names("rigs")}
    able = [each for each, one in loaded.items() if one and issubclass(one, DrivenRig)]
    return f"rig {rig} cannot play a drive of our own. These can: {', '.join(able) or 'none'}."
