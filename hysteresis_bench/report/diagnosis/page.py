"""The page of a diagnosis: the verdict, before and after, what was considered, what is left, what to measure next."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path

from hysteresis_bench.diagnosis.evidence.residual_tests import OVERALL, ResidualTest
from hysteresis_bench.diagnosis.findings.candidates import Candidate
from hysteresis_bench.diagnosis.findings.result import Diagnosis
from hysteresis_bench.diagnosis.findings.words import WRONG
from hysteresis_bench.diagnosis.hypotheses.cross_validation import CLEAR
from hysteresis_bench.diagnosis.search.selection import LEVEL
from hysteresis_bench.registry import DESCRIPTION
from hysteresis_bench.report.diagnosis.before_after import (
    besides_ties,
    errors_table,
    record_pictures,
    rmse_in,
    sentence,
)
from hysteresis_bench.report.diagnosis.figures import waterfall
from hysteresis_bench.report.shared.page import NONE, Cell, Table, listed, number, percent, probability, render
from hysteresis_bench.report.shared.theme import Picture

FILE = "diagnosis.html"

MOST = 6
"""Records that are drawn."""


def write_diagnosis_page(folder: Path, diagnosis: Diagnosis, files: Sequence[Path] = ()) -> Path:
    """Write diagnosis.html and figures/*.svg into the folder; returns the page.

    files : the data's, told of by name and SHA-256
    """
    folder.mkdir(parents=True, exist_ok=True)
    page = folder / FILE
    text = render(
        "diagnosis.html.j2",
        title=_title(diagnosis),
        kicker=f"Diagnosis of {listed([file.stem for file in files] or list(diagnosis.split['fitted']))}",
        answer=[diagnosis.headline, *_answers(diagnosis)],
        warnings=besides_ties(diagnosis.warnings, [(tie.effect, tie.rival) for tie in diagnosis.ties]),
        waterfall=_waterfall(folder, diagnosis),
        errors=_errors(diagnosis),
        records=_records(folder, diagnosis),
        undrawn=max(0, diagnosis.responses["record"].nunique() - MOST),
        candidates=_candidates(diagnosis),
        inapplicable=[c for c in diagnosis.candidates if not c.applicable],
        ties=diagnosis.ties,
        added=_added(diagnosis),
        tests=_tests(diagnosis, overall=True),
        single=_tests(diagnosis, overall=False),
        equation=str(diagnosis.equation) if diagnosis.equation and diagnosis.equation.terms else "",
        advice=diagnosis.advice,
        facts=_facts(diagnosis, files),
    )
    page.write_text(text, encoding="utf-8")
    return page


def _title(diagnosis: Diagnosis) -> str:
    model = diagnosis.model_name
    unexplained = diagnosis.verdict == "unexplained-residual"
    if set(diagnosis.effects) - {DESCRIPTION}:
        more = ", and something without a name" if unexplained else ""
        tied = {tie.effect for tie in diagnosis.ties}
        names = [f"{name} or its like" if name in tied else name for name in diagnosis.effects if name != DESCRIPTION]
        lacks = "may lack" if diagnosis.after.fitted.rmse > WRONG * diagnosis.floor else "lacks"
        return f"{model} {lacks} {listed(names)}{more}"
    return f"{model} leaves something that no effect explains" if unexplained else f"{model} lacks nothing known here"


def _answers(diagnosis: Diagnosis) -> list[str]:
    """What follows the verdict: memory, ties, the next experiment."""
    told = [sentence(diagnosis.memory.words)]
    if diagnosis.ties:
        rivals = {tie.effect: [t.rival for t in diagnosis.ties if t.effect == tie.effect] for tie in diagnosis.ties}
        parts = [f"{name} or, as well, {listed(others)}" for name, others in rivals.items()]
        told.append(f"These data do not tell apart {'; '.join(parts)}.")
    if diagnosis.advice:
        told.append(diagnosis.advice.words)
    return told


def _waterfall(folder: Path, diagnosis: Diagnosis) -> Picture:
    before, after = diagnosis.before.held_out, diagnosis.after.held_out
    ends = (before.rmse if before else None, after.rmse if after else None)
    return waterfall(folder, diagnosis.waterfall, ends, diagnosis.units)


def _errors(diagnosis: Diagnosis) -> Table:
    before, after = (
        {"fitted": stage.fitted.as_dict(), "held_out": stage.held_out.as_dict() if stage.held_out else None}
        for stage in (diagnosis.before, diagnosis.after)
    )
    offset = f" Both have the offset {diagnosis.offset}." if diagnosis.offset in diagnosis.before.names else ""
    note = f"Relative to the largest |output − offset| measured.{offset} {sentence(diagnosis.noise.words)}"
    return errors_table(before, after, diagnosis.floor, diagnosis.units, note)


def _records(folder: Path, diagnosis: Diagnosis) -> list[tuple[str, Picture, Picture]]:
    """Heading, loop and residual of each drawn record; those held out come first."""
    groups = list(diagnosis.responses.groupby("record", sort=False))
    groups.sort(key=lambda group: group[1]["role"].iloc[0] != "held-out")
    shown = [group for half in _both(groups) for group in half][:MOST]
    return [
        record_pictures(folder, str(index), rows, diagnosis.floor, diagnosis.units)
        for index, (_, rows) in enumerate(shown, 1)
    ]


def _both(groups: list) -> tuple[list, list]:
    """At most half of the drawn records are held-out ones, where there are enough others."""
    held = [group for group in groups if group[1]["role"].iloc[0] == "held-out"]
    fitted = groups[len(held) :]
    return held[: max(MOST // 2, MOST - len(fitted))], fitted


def _candidates(diagnosis: Diagnosis) -> Table:
    rows = [_candidate(candidate, diagnosis) for candidate in diagnosis.candidates if candidate.applicable]
    return Table(
        "Effects considered",
        [
            "Effect",
            "Verdict",
            f"{rmse_in(diagnosis.units)}, blocks left out",
            "p",
            "Clear by",
            "Explains",
            "Its parameters",
            "Tied with",
        ],
        rows,
        note="An adopted effect is judged against the final model without it, any other against the final model with "
        "it. p of the nested-model test, before the correction for the number of candidates. Clear by: how many "
        "standard errors it wins on blocks of samples that were left out of the fit. Explains: its share of the mean "
        "square over the noise that is left without it; what explains less than half is not named, as it may be a part "
        "of what is wrong for another reason.",
    )


def _candidate(candidate: Candidate, diagnosis: Diagnosis) -> list[str | Cell]:
    if candidate.adopted:
        verdict = Cell("adopted", "good", strong=True)
    elif candidate.tied_with:
        verdict = Cell("tied", "bad")
    elif candidate.p < LEVEL and candidate.advantage > CLEAR:
        verdict = Cell("too small a part", "quiet")
    else:
        verdict = Cell("not needed", "quiet")
    values = [
        f"{name} {number(value, 3)}{' (at its bound)' if any(key.endswith(name) for key in candidate.at_bound) else ''}"
        for name, value in (candidate.parameters or {}).items()
    ]
    return [
        Cell(candidate.effect, strong=candidate.adopted),
        verdict,
        number(candidate.cv_rmse),
        probability(candidate.p),
        number(candidate.advantage, 2),
        percent(candidate.share),
        Cell(", ".join(values) or NONE, "prose"),
        listed(candidate.tied_with) if candidate.tied_with else NONE,
    ]


def _added(diagnosis: Diagnosis) -> Table | None:
    """Parameters of the adopted effects, with standard errors."""
    names = {*diagnosis.effects, diagnosis.offset} - {""}
    rows: list[list[str | Cell]] = []
    for name, estimate in diagnosis.model.parameters.items():
        effect = name.rpartition(".")[0] or name
        if effect not in names:
            continue
        error = estimate.standard_error
        share = abs(error / estimate.value) if error is not None and estimate.value else None
        rows.append(
            [
                name,
                number(estimate.value, 5),
                number(error, 2) if error is not None else "not determined",
                Cell(percent(share, 2), "bad" if share is not None and share > 1 else ""),
                "" if estimate.unit == "1" else estimate.unit,
            ]
        )
    if not rows:
        return None
    header = ["Parameter", "Value", "Standard error", "Of the value", "Unit"]
    note = "Standard errors allow for correlated residuals; they do not know of what the model lacks."
    return Table("Parameters that came with the effects", header, rows, note=note)


def _tests(diagnosis: Diagnosis, overall: bool) -> Table:
    """What was looked for in the residual, before and after."""
    several = any(test.record == OVERALL for test in diagnosis.after.tests)

    def chosen(tests: Sequence[ResidualTest]) -> dict[tuple[str, str], ResidualTest]:
        return {(t.record, t.name): t for t in tests if (t.record == OVERALL or not several) == overall}

    before, after = chosen(diagnosis.before.tests), chosen(diagnosis.after.tests)
    rows: list[list[str | Cell]] = []
    for key, test in after.items():
        first = before.get(key)
        name = test.name.replace("-", " ")
        rows.append(
            [
                name if overall else f"{test.record}, {name}",
                Cell(probability(first.corrected_p) if first else NONE, "bad" if first and first.significant else ""),
                Cell(probability(test.corrected_p), "bad" if test.significant else ""),
                Cell(percent(test.share, 2)),
                Cell(sentence(test.words), "prose"),
            ]
        )
    caption = "Is there structure in the residual?" if overall else "Record by record"
    header = ["Looked for", "p before", "p after", "Of its variance", "After, in words"]
    note = "p corrected for all tests made, and for samples that are not independent."
    return Table(caption, header, rows, note=note)


def _facts(diagnosis: Diagnosis, files: Sequence[Path]) -> list[tuple[str, str]]:
    split = diagnosis.split
    facts = [
        ("Fitted", listed(split["fitted"], 12)),
        ("Held out", listed(split["held_out"], 12)),
        ("Split", str(split["how"])),
        ("Noise", diagnosis.noise.words),
    ]
    facts += [(f"SHA-256 of {file.name}", hashlib.sha256(file.read_bytes()).hexdigest()) for file in files]
    return facts + [(package, version) for package, version in diagnosis.model.created_by.items()]
