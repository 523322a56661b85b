"""A study of diagnosis itself: many cases in worker processes, and the tables of what became of them.

A case is a bench (a rig with effects switched on or off) and a number. Every finished case is a JSON file in the
results folder, so that a study goes on where it stopped; a case that failed is a row like any other.
"""

from __future__ import annotations

import json
import os
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import pandas as pd
from pydantic import ValidationError

from hysteresis_bench import registry
from hysteresis_bench.diagnosis_study.case import BenchSpec, Case, CaseTicket, DiagnosisStudy, build_rig, run_case
from hysteresis_bench.errors import UserError
from hysteresis_bench.study.pool import run_tickets

KIND = "diagnosis"
STUDY, CASES, CONFUSION, FOLDER = "study.toml", "cases.csv", "confusion.csv", "cases"
NOTHING = "nothing"


@dataclass(frozen=True)
class Told:
    """Told after every case, and once before the first (case None)."""

    done: int
    total: int
    case: Case | None


def is_diagnosis_study(path: Path) -> bool:
    """Does the file say so? A file that cannot be read is left to whoever reads it next."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8")).get("kind") == KIND
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
        return False


def read_diagnosis_study(path: Path) -> tuple[DiagnosisStudy, str]:
    """A study and its text. Raises UserError telling every fault of the file."""
    try:
        text = path.read_text(encoding="utf-8")
        study = DiagnosisStudy.model_validate(tomllib.loads(text))
    except OSError as error:
        raise UserError(str(path), f"cannot be read: {error.strerror}.") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UserError(str(path), f"is not valid TOML: {error}.") from error
    except ValidationError as error:
        told = [f"{'.'.join(map(str, fault['loc']))}: {fault['msg']}." for fault in error.errors()]
        raise UserError(str(path), told) from error
    faults = [f"{bench.name}: {fault}" for bench in study.bench for fault in _faults(bench)]
    names = [bench.name for bench in study.bench]
    faults += [f'two benches are named "{name}".' for name in sorted({n for n in names if names.count(n) > 1})]
    if faults:
        raise UserError(str(path), faults)
    return study, text


def run_diagnosis_study(
    path: Path | str,
    trials: int | None = None,
    jobs: int | None = None,
    out: Path | str | None = None,
    tell: Callable[[Told], None] = lambda told: None,
) -> Path:
    """Run every case that is not in the results folder yet, and write the tables; returns that folder.

    trials : cases of every bench, times its share; default the file's. jobs : worker processes, all cores by default
    Raises UserError for a fault in the file or a folder that holds another study.
    """
    path = Path(path)
    study, text = read_diagnosis_study(path)
    folder = Path(out) if out else Path("results") / path.stem
    (folder / FOLDER).mkdir(parents=True, exist_ok=True)
    _same(folder, study)
    (folder / STUDY).write_text(text, encoding="utf-8")
    cases, missing = read_cases(folder), []
    for bench in study.bench:
        for number in range((trials or study.trials) * bench.share):
            ticket = CaseTicket(study.model_dump_json(), bench.name, number)
            if not (folder / FOLDER / ticket.file).is_file():
                missing.append(ticket)
    total = len(cases) + len(missing)
    tell(Told(len(cases), total, None))
    for ticket, case, status, reason in run_tickets(missing, run_case, jobs or os.cpu_count() or 1, study.timeout):
        if case is None:
            model = next(bench.model for bench in study.bench if bench.name == ticket.bench)
            case = Case(ticket.bench, model, ticket.number, status, reason)
        whole = folder / FOLDER / f"{ticket.file}.part"
        whole.write_text(json.dumps(asdict(case), indent=1) + "\n", encoding="utf-8")
        whole.rename(folder / FOLDER / ticket.file)  # a killed run leaves no half a case
        cases.append(case)
        tell(Told(len(cases), total, case))
    cases = read_cases(folder)
    pd.DataFrame([{**asdict(case), "right": case.right} for case in cases]).to_csv(folder / CASES, index=False)
    confusion(cases).to_csv(folder / CONFUSION)
    return folder


def read_cases(folder: Path) -> list[Case]:
    """All finished cases, in the study's order of benches, then by number."""
    found = [Case(**json.loads(file.read_text(encoding="utf-8"))) for file in (folder / FOLDER).glob("*.json")]
    return sorted(found, key=lambda case: (case.bench, case.number))


def confusion(cases: Sequence[Case]) -> pd.DataFrame:
    """Cases by hidden effect (rows) and what was claimed for it (columns).

    A hidden effect that was named counts under its name; one that was not, under every claim that was extra or
    tied in its case, or under "nothing". Extra claims of cases with nothing missed stand in the row "nothing".
    """
    pairs = []
    for case in (case for case in cases if case.status == "done"):
        named, wrong = case.named.split(), case.extra.split()
        spare = [name for name in case.claimed.split() if not any(name in entry.split("|") for entry in named)]
        pairs += [(entry, next(n for n in entry.split("|") if n in case.claimed.split())) for entry in named]
        for entry in [*case.tied.split(), *case.missed.split()]:
            pairs += [(entry, name) for name in spare or [NOTHING]]
        if not case.missed:
            pairs += [(NOTHING, name) for name in wrong]
        if not case.hidden and not case.claimed:
            pairs.append((NOTHING, NOTHING))
    table = pd.DataFrame(pairs, columns=["hidden", "claimed"])
    return pd.crosstab(table["hidden"], table["claimed"])


def _faults(bench: BenchSpec) -> list[str]:
    settings = {**bench.settings, **({bench.vary: 0} if bench.vary else {})}
    found = [*registry.faults("rigs", bench.rig, settings), *registry.faults("models", bench.model, {})]
    if found:
        return found
    known = build_rig(bench, 0).experiments
    asked = [*bench.fitted, *bench.held_out, *bench.fresh]
    return [f'{bench.rig} has no experiment "{name}".' for name in asked if name not in known]


def _same(folder: Path, study: DiagnosisStudy) -> None:
    """Raises UserError where the folder holds another study; `trials`, words and more benches make no other."""
    if not (folder / STUDY).is_file():
        return
    before, _ = read_diagnosis_study(folder / STUDY)
    now = {bench.name: bench for bench in study.bench}
    faults = [f'bench "{b.name}" is not the same.' for b in before.bench if now.get(b.name, b) != b]
    if before.seed != study.seed:
        faults.append(f"seed was {before.seed} there and is {study.seed} here.")
    if faults:
        raise UserError(f"{folder} holds another study", [*faults, "Choose another folder with --out."])
