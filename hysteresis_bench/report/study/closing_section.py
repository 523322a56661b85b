"""The end of a study's report: the bare model, what it lacks, the error before and after where nothing was fitted."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from markupsafe import Markup

from hysteresis_bench.diagnosis.findings.diagnosis_file import complete
from hysteresis_bench.report.diagnosis.before_after import (
    besides_ties,
    errors_table,
    record_blocks,
    step_by_step,
    ties_in_words,
)
from hysteresis_bench.report.diagnosis.in_print import in_print
from hysteresis_bench.report.diagnosis.page import FILE, description, in_short
from hysteresis_bench.report.shared.blocks import Block, Bullets, Figures, Paragraph
from hysteresis_bench.report.shared.page import Section
from hysteresis_bench.report.shared.text import listed, sentence
from hysteresis_bench.study.kept_files.closing_files import CLOSING, Closing
from hysteresis_bench.study.results import Results
from hysteresis_bench.study.study_file import ClosingSpec

PLACE = "closing"
"""What the names of the section's figures begin with."""

OLDER = (
    "This diagnosis was made by an older version of the program, which asked less of the data than today’s; the trials "
    f"are as they were. Remove the folder {CLOSING} and run the study again to have it anew."
)


def section(results: Results, folder: Path) -> Section | None:
    """None where the study asks for no diagnosis; the section's figures are written to the folder.

    Where the diagnosis did not finish, the verdict says so, and there are neither table nor figures.
    """
    spec, closing = results.study.closing, results.closing
    if spec is None or closing is None:
        return None
    blocks: list[Block] = [f"The paper on what its model lacks: {spec.says}"] if spec.says else []
    blocks += _asked(spec, closing)
    if closing.finished:
        blocks += _found(closing, folder)
    else:
        blocks.append(Paragraph(closing_in_words(closing), "strong"))
    return Section("closing", "Closing the loop", blocks)


def closing_in_words(closing: Closing) -> str:
    """One sentence: the verdict, or why there is none."""
    if closing.finished:
        age = " (A diagnosis of an older version.)" if _older(closing) else ""
        return f"Closing the loop: {closing.diagnosis['headline']}{age}"
    status, reason = closing.outcome["status"], closing.outcome["reason"]
    return sentence(f"The loop was not closed, the diagnosis has no result ({status}): {reason}")


def _older(closing: Closing) -> bool:
    """Whether the diagnosis says nothing of what one of today says."""
    return not set(complete(closing.diagnosis)) <= set(closing.diagnosis)


def _asked(spec: ClosingSpec, closing: Closing) -> Iterator[str]:
    known = f" with {listed(spec.effects)}, known to act," if spec.effects else ""
    yield (
        f"Diagnosed: {spec.model}{known} fitted to {listed(spec.fitted)}. {listed(spec.held_out)} "
        f"{'was' if len(spec.held_out) == 1 else 'were'} held out: fitted by nobody, opened once, at the end."
    )
    hidden = closing.outcome.get("hidden", [])
    if hidden:
        yield f"The virtual rig is built with {listed(hidden)}; the diagnosis was not told."


def _found(closing: Closing, folder: Path) -> Iterator[Block]:
    found, units = complete(closing.diagnosis), closing.units
    noise = found["noise_rms"] or 0.0
    yield from in_short(found["headline"])
    if _older(closing):
        yield Paragraph(OLDER, "note")
    if found["ties"]:
        yield "What these data cannot tell apart:"
        yield Bullets([in_print(words) for words in ties_in_words(found["ties"])])
    if caveats := besides_ties(found["warnings"], found["ties"]):
        yield "Before you believe it:"
        yield Bullets([in_print(words) for words in caveats])
    yield errors_table(found, noise, units)
    yield Figures([step_by_step(folder, found, units, name=f"{PLACE}-waterfall")])
    held_out = closing.responses[closing.responses["role"] == "held-out"]
    for i, (_, rows) in enumerate(held_out.groupby("record", sort=False), 1):
        yield from record_blocks(folder, f"{PLACE}-{i}", rows, noise=noise, units=units)
    yield from description(found)
    if found["advice"]:
        yield in_print(found["advice"])
    link = Markup('<a href="{}">the whole diagnosis</a>').format(f"{CLOSING}/{FILE}")
    yield Markup("Every candidate, test and parameter: {}.").format(link)
