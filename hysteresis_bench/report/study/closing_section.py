"""The end of a study's report: the bare model, what it lacks, the error before and after where nothing was fitted."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from hysteresis_bench.diagnosis.findings.terms import Equation
from hysteresis_bench.report.diagnosis.before_after import besides_ties, errors_table, record_pictures, sentence
from hysteresis_bench.report.diagnosis.figures import waterfall
from hysteresis_bench.report.shared.page import Table, listed
from hysteresis_bench.report.shared.theme import Picture
from hysteresis_bench.study.afterwards.closing_files import Closing
from hysteresis_bench.study.results import Results
from hysteresis_bench.study.study_file import ClosingSpec

NOTHING = Equation((), 0.0)
"""As diagnosis.json tells of a residual that no terms describe."""

PLACE = "closing"
"""What the names of the section's figures begin with."""


@dataclass(frozen=True)
class ClosingView:
    """The section as the page shows it.

    verdict : in a sentence;  asked : what was fitted and held out;  says : the paper's own statement
    records : heading, loop and residual of what was held out;  ties, caveats : as the diagnosis tells them
    left : a formula that describes what is left, not physics;  advice : what to measure next
    page : of the whole diagnosis, relative to the report
    Where the diagnosis did not finish, the verdict says so, and there are neither table nor figures.
    """

    verdict: str
    asked: list[str]
    says: str
    errors: Table | None
    waterfall: Picture | None
    records: list[tuple[str, Picture, Picture]]
    ties: list[str]
    caveats: list[str]
    left: str
    advice: str
    page: str | None


def closing_view(results: Results, folder: Path) -> ClosingView | None:
    """None where the study asks for no diagnosis; the section's figures are written to the folder."""
    spec, closing = results.study.closing, results.closing
    if spec is None or closing is None:
        return None
    asked = list(_asked(spec, closing))
    if not closing.finished:
        return ClosingView(closing_in_words(closing), asked, spec.says, None, None, [], [], [], "", "", None)
    told, units = closing.diagnosis, closing.units
    noise = told["noise_rms"] or 0.0
    note = f"Relative to the largest |output − offset| measured. {sentence(told['noise']['words'])}"
    steps = [(step["system"], step["rmse"]) for step in told["waterfall"]]
    ends = told["before"]["held_out"]["rmse"], told["after"]["held_out"]["rmse"]
    groups = [rows for _, rows in closing.responses.groupby("record", sort=False)]
    return ClosingView(
        told["headline"],
        asked,
        spec.says,
        errors_table(told["before"], told["after"], noise, units, note),
        waterfall(folder, steps, ends, units, f"{PLACE}-waterfall"),
        [record_pictures(folder, f"{PLACE}-{i}", rows, noise, units) for i, rows in enumerate(groups, 1)],
        [f"{tie['effect']} and {tie['rival']}: {tie['reason']}." for tie in told["ties"]],
        besides_ties(told["warnings"], [(tie["effect"], tie["rival"]) for tie in told["ties"]]),
        "" if told["unexplained"] in (None, str(NOTHING)) else told["unexplained"],
        told["advice"] or "",
        closing.page,
    )


def closing_in_words(closing: Closing) -> str:
    """One sentence: the verdict, or why there is none."""
    if closing.finished:
        return f"Closing the loop: {closing.diagnosis['headline']}"
    status, reason = (closing.outcome[key] for key in ("status", "reason"))
    return sentence(f"The loop was not closed, the diagnosis has no result ({status}): {reason}")


def _asked(spec: ClosingSpec, closing: Closing) -> Iterator[str]:
    known = f" with {listed(spec.effects)}, known to act," if spec.effects else ""
    yield (
        f"Diagnosed: {spec.model}{known} fitted to {listed(spec.fitted)}. {listed(spec.held_out)} "
        f"{'was' if len(spec.held_out) == 1 else 'were'} held out: fitted by nobody, opened once, at the end."
    )
    hidden = closing.outcome.get("hidden", [])
    if hidden:
        yield f"The virtual rig is built with {listed(hidden)}; the diagnosis was not told."
