"""The page of a diagnosis: the verdict, before and after, what was considered, what is left, what to measure next."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from hysteresis_bench.diagnosis.doubt.cause import Cause
from hysteresis_bench.diagnosis.findings.diagnosis_file import MODEL, KeptDiagnosis, read_diagnosis
from hysteresis_bench.diagnosis.structure.curves import read_curves
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.model_file import read_model
from hysteresis_bench.report.diagnosis.before_after import (
    besides_ties,
    errors_table,
    record_blocks,
    step_by_step,
    ties_in_words,
)
from hysteresis_bench.report.diagnosis.figures import family_curve
from hysteresis_bench.report.diagnosis.in_print import first_sentence, in_print
from hysteresis_bench.report.diagnosis.tables import added_table, agreement_table, candidates_table, tests_tables
from hysteresis_bench.report.laws.memory import memory_section
from hysteresis_bench.report.laws.structure import structure_section
from hysteresis_bench.report.laws.tables import laws_figure, laws_table
from hysteresis_bench.report.shared.blocks import (
    Block,
    Bullets,
    Cell,
    Details,
    Figures,
    Heading,
    Paragraph,
    Table,
    Terms,
)
from hysteresis_bench.report.shared.page import Page, Section
from hysteresis_bench.report.shared.text import NONE, listed, percent, sentence

FILE = "diagnosis.html"

RECORDS_DRAWN = 6
"""Records that are drawn."""


def write_diagnosis_page(folder: Path, files_kept: bool = True) -> Path:
    """Write diagnosis.html and figures/*.svg from a diagnosis' files, into their folder; returns the page.

    files_kept : does the page link to its figures?
    Raises UserError where the folder holds no diagnosis.
    """
    kept = read_diagnosis(folder)
    found = kept.diagnosis
    data = [Path(name).stem for name in found["data"]["files"]]
    page = Page(
        _title(found),
        f"Diagnosis of {listed(data or found['split']['fitted'])}",
        [section for section in _sections(folder, kept) if section],
        [*in_short(found["headline"]), *map(in_print, _answers(found))],
        answers="The verdict",
        warnings=[in_print(warning) for warning in besides_ties(found["warnings"], found["ties"])],
        warned="Before you believe it",
        files_kept=files_kept,
    )
    return page.write(folder / FILE)


def in_short(headline: str) -> Iterator[Block]:
    """A headline: its first sentence strong, the others as they are."""
    first, others = first_sentence(in_print(headline))
    yield Paragraph(first, "strong")
    if others:
        yield others


def _sections(folder: Path, kept: KeptDiagnosis) -> Iterator[Section | None]:
    found, units = kept.diagnosis, kept.model["units"]
    offset = f" Both have the offset {found['offset_of_both']}." if found["offset_of_both"] else ""
    errors: list[Block] = [
        Figures([step_by_step(folder, found, units)]),
        errors_table(found, found["floor"], units, more=offset),
    ]
    yield Section("errors", "The error, before and after", errors)
    yield _measured(found["measured"])
    if laws := found["laws"]:
        drawn = laws_figure(folder, laws["laws"], floor=laws["floor"], units=units)
        table = laws_table(laws["laws"], found["model"], laws["floor"], units)
        yield Section("laws", "Which law", [in_print(laws["words"]), Figures([drawn]), table])
        yield structure_section(folder, told, read_curves(folder), units) if (told := laws["structure"]) else None
    yield _memory(folder, kept)
    yield _families(folder, found["families"])
    yield _records(folder, kept)
    yield _considered(kept)
    yield Section("advice", "What to measure next", [in_print(found["advice"])]) if found["advice"] else None
    overall, single = tests_tables(found["residual"])
    left: list[Block] = [*description(found), overall]
    if single.rows:
        left.append(Details("The same for every record", [single]))
    yield Section("left", "What is left", left)
    yield Section("notes", "How it was made", [Terms(_facts(kept))])


def _memory(folder: Path, kept: KeptDiagnosis) -> Section | None:
    """None where the law's plugin is not here any more."""
    try:
        fitted = read_model(folder / MODEL)
    except UserError:
        return None
    known = kept.responses[kept.responses["role"] == "fitted"]
    inputs = [rows["input"].to_numpy(float) for _, rows in known.groupby("record", sort=False)]
    return memory_section(folder, fitted, [fitted.preparation.measured_input(u) for u in inputs])


def _measured(measured: Mapping[str, Any] | None) -> Section | None:
    """What became of the ties by the experiment that was carried out; none where none was."""
    if not measured:
        return None
    rows: list[list[str | Cell]] = [
        [
            Cell(listed(tie["names"]), "prose"),
            NONE if tie["probability"] is None else percent(tie["probability"], 2),
            Cell(tie["words"], "good" if tie["settled"] else "prose"),
        ]
        for tie in measured["ties"]
    ]
    table = Table("What it settled", ["Tied before", "Expected to be settled", "Now"], rows)
    return Section("measured", "The experiment that was carried out", [*measured["notes"], table])


def _families(folder: Path, families: Sequence[Mapping[str, Any]]) -> Section | None:
    """What none of its formulas fits: a sentence and a curve each."""
    if not families:
        return None
    drawn = [family_curve(folder, found) for found in families]
    words = [in_print(sentence(found["words"])) for found in families]
    return Section("families", "What no formula here fits", [Bullets(words), Figures(drawn)])


def _title(found: Mapping[str, Any]) -> str:
    model = found["model"]
    unexplained = found["verdict"] == "unexplained-residual"
    better = found["better_law"]
    if effects := [name for name in found["effects"] if name not in found["described"]]:
        more = f", and its law is not the best: {better['model']} is" if better else ""
        rest = "its law does not follow the data" if found["agreement"] else "something without a name"
        more = more or (f", and {rest}" if unexplained else "")
        tied = {tie["effect"] for tie in found["ties"]}
        names = [f"{name} or its like" if name in tied else name for name in effects]
        return f"{model} {'may lack' if found['doubtful'] else 'lacks'} {listed(names)}{more}"
    if better and Cause(**better).as_well:
        return f"{model} may not be the law here: {better['model']} follows as well, with less around it"
    if better:
        return f"{model} is not the law here: {better['model']} does better"
    if carrying := found["carrying"]:
        return f"{model} is not the law here: {listed(carrying)} carries the loop"
    return f"{model} leaves something that no effect explains" if unexplained else f"{model} lacks nothing known here"


def _answers(found: Mapping[str, Any]) -> Iterator[str]:
    """What follows the verdict: what a black box reaches, what was measured, memory, ties, the next experiment."""
    if found["ceiling"]:
        yield found["ceiling"]["words"]
    if measured := found["measured"]:
        yield f"{measured['words']} Before: {measured['before']['headline']}"
    yield sentence(found["hysteresis"]["words"])
    if sure := found["certainty"]:
        told = [f"{name} {percent(p)}" for name, one in sure.items() if (p := one["probability"]) is not None]
        yield (
            f"How often such claims were right on made cases, tied effects counted as one: {listed(told)}."
            if told
            else "How sure the names are is not known: more is left here than on the made cases that could tell."
        )
    if ties := found["ties"]:
        rivals = {tie["effect"]: [t["rival"] for t in ties if t["effect"] == tie["effect"]] for tie in ties}
        parts = [f"{name} or, as well, {listed(others)}" for name, others in rivals.items()]
        yield f"These data do not tell apart {'; '.join(parts)}."
    if found["advice"]:
        yield found["advice"]


def _records(folder: Path, kept: KeptDiagnosis) -> Section:
    """Loop and residual of each drawn record; those held out come first."""
    blocks: list[Block] = []
    shown = _shown([rows for _, rows in kept.responses.groupby("record", sort=False)])
    for index, rows in enumerate(shown, 1):
        blocks += record_blocks(folder, str(index), rows, noise=kept.diagnosis["floor"], units=kept.model["units"])
    split = kept.diagnosis["split"]
    undrawn = len({*split["fitted"], *split["held_out"], *kept.responses["record"]}) - len(shown)
    if undrawn:
        blocks.append(Paragraph(f"{undrawn} more records are not drawn.", "note"))
    return Section("records", "Loop and residual, before and after", blocks)


def _shown(records: Sequence[pd.DataFrame]) -> list[pd.DataFrame]:
    """At most half of the drawn records are held-out ones, where there are enough others."""
    held_out = [rows for rows in records if rows["role"].iloc[0] == "held-out"]
    fitted = [rows for rows in records if rows["role"].iloc[0] != "held-out"]
    return [*held_out[: max(RECORDS_DRAWN // 2, RECORDS_DRAWN - len(fitted))], *fitted][:RECORDS_DRAWN]


def _considered(kept: KeptDiagnosis) -> Section:
    found = kept.diagnosis
    units = kept.model["units"]
    blocks: list[Block] = [candidates_table(found["candidates"], units, kept.model)]
    if agreed := found["agreement"]:
        blocks.append(agreement_table(agreed, found["floor"], units))
    if found["ties"]:
        blocks += [
            Heading("What these data cannot tell apart"),
            Bullets([in_print(words) for words in ties_in_words(found["ties"])]),
        ]
    impossible = [in_print(f"{c['effect']}: {c['reason']}.") for c in found["candidates"] if not c["applicable"]]
    if impossible:
        blocks.append(Details("Effects that these data or this model cannot show", [Bullets(impossible)]))
    around = [*found["effects"], *found["stand_ins"], *([found["offset"]] if found["offset"] else [])]
    if added := added_table(kept.model, around):
        blocks.append(added)
    return Section("candidates", "What was considered", blocks)


def description(found: Mapping[str, Any]) -> list[Block]:
    """The formula for what is left, where there is one."""
    if not found["equation"]:
        return []
    return ["A description of what is left, not physics:", Paragraph(found["equation"]["text"], "code")]


def _facts(kept: KeptDiagnosis) -> list[tuple[str, str]]:
    found, data = kept.diagnosis, kept.diagnosis["data"]
    split = found["split"]
    return [
        ("Fitted", listed(split["fitted"], 12)),
        ("Held out", listed(split["held_out"], 12)),
        ("Split", str(split["how"])),
        ("Noise", in_print(found["noise"]["words"])),
        *((f"SHA-256 of {name}", sha) for name, sha in zip(data["files"], data["sha256"], strict=True)),
        *kept.model["created_by"].items(),
    ]
