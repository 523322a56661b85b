"""The tables of a diagnosis: candidates, parameters that came with the effects, residual tests."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from hysteresis_bench.diagnosis.evidence.residual_tests import OVERALL
from hysteresis_bench.diagnosis.findings.diagnosis_file import ADOPTED, TIED
from hysteresis_bench.report.diagnosis.in_print import in_print
from hysteresis_bench.report.shared.blocks import ESTIMATE_HEADER, ESTIMATE_NOTE, Cell, Table, estimate_cells
from hysteresis_bench.report.shared.text import (
    NONE,
    Units,
    listed,
    named,
    number,
    percent,
    probability,
    sentence,
)

TONES = {ADOPTED: "good", TIED: "bad"}


def candidates_table(candidates: Sequence[Mapping[str, Any]], units: Units, model: Mapping[str, Any]) -> Table:
    """Every effect that the data and the model can show; model : the content of model.json"""
    unknown = undetermined(model)
    rmse = named("RMSE", units, "output")
    return Table(
        "Effects considered",
        [
            "Effect",
            "Verdict",
            f"{rmse}, blocks left out",
            "p",
            "Clear by",
            "Explains",
            "Its parameters, in the search",
            "Tied with",
        ],
        [_candidate(candidate, unknown) for candidate in candidates if candidate["applicable"]],
        note="An adopted effect is judged against the final model without it, any other against the final model with "
        "it. p of the nested-model test or of blocks of samples that were left out of the fit, twice the smaller one, "
        "before the correction for the number of candidates. Clear by: how many standard errors it wins on these "
        "blocks. Explains: its share of the mean square over the noise that is left without it; what explains less "
        "than half is not named, as it may be a part of what is wrong for another reason. Its parameters are of the "
        "fit that the search judged it by, to thinned records; the final fit, to all samples, is in the table below, "
        "and differs where parameters make up for each other.",
    )


def agreement_table(agreed: Mapping[str, Any], floor: float, units: Units) -> Table:
    """What each law needs that leaves no more than the one that was asked about."""
    rows: list[list[str | Cell]] = [
        [
            Cell(law, strong=not place),
            number(agreed["left"][law], 3),
            number(agreed["left"][law] / floor, 3),
            Cell(listed(needed) or NONE, "prose"),
        ]
        for place, (law, needed) in enumerate(agreed["needs"].items())
    ]
    return Table(
        "What each law needs",
        ["Law", f"{named('RMSE', units, 'output')}, some samples", "times the noise", "Needs"],
        rows,
        note="The law that was asked about, then all rate-independent ones that leave no more of the same samples, "
        "each with those of the effects in question that it needs. An effect that all of them need, or one like it, "
        "makes up for the fault of none. What has no dynamics, such as a curve of the output, any law may have in its "
        "shape.",
    )


def undetermined(model: Mapping[str, Any]) -> set[str]:
    """EFFECT.PARAMETER of the final fit whose standard error is as large as the value, or that the data cannot tell."""
    estimates = {
        f"{effect['effect']}.{name}": estimate
        for effect in model["effects"]
        for name, estimate in effect["parameters"].items()
    }
    return {name for name, each in estimates.items() if _unsure(each["value"], each["standard_error"])}


def _unsure(value: float, error: float | None) -> bool:
    return error is None or not math.isfinite(error) or error > abs(value)


def _candidate(candidate: Mapping[str, Any], unknown: set[str]) -> list[str | Cell]:
    adopted, judgement = candidate["adopted"], candidate["judgement"]
    values = []
    for name, value in candidate["parameters"].items():
        bound = " (at its bound)" if any(key.endswith(name) for key in candidate["at_bound"]) else ""
        doubt = " (not determined)" if f"{candidate['effect']}.{name}" in unknown else ""
        values.append(f"{name} {number(value, 3)}{bound}{doubt}")
    return [
        Cell(candidate["effect"], strong=adopted),
        Cell(judgement, TONES.get(judgement, "quiet"), strong=adopted),
        number(candidate["cv_rmse"]),
        probability(candidate["p_value"]),
        number(candidate["advantage"], 2),
        percent(candidate["share"]),
        Cell(", ".join(values) or NONE, "prose"),
        listed(candidate["tied_with"]) if candidate["tied_with"] else NONE,
    ]


def added_table(model: Mapping[str, Any], effects: Sequence[str]) -> Table | None:
    """Parameters of the adopted effects with standard errors; None without one.

    model : the content of model.json. What the model itself offers as an effect has the effect's name there.
    """
    found = [(name, estimate) for name, estimate in model["parameters"].items() if name in effects]
    for effect in model["effects"]:
        if effect["effect"] in effects:
            found += [(f"{effect['effect']}.{name}", estimate) for name, estimate in effect["parameters"].items()]
    rows = [estimate_cells(name, each["value"], each["standard_error"], unit=each["unit"]) for name, each in found]
    note = f"Of the final fit, to all samples. {ESTIMATE_NOTE}"
    if unsure := [name for name, each in found if _unsure(each["value"], each["standard_error"])]:
        note += f" The effect is needed, but these data do not tell the value of {listed(unsure)}: it is no result."
    return Table("Parameters that came with the effects", ESTIMATE_HEADER, rows, note) if rows else None


def tests_tables(residual: Mapping[str, Sequence[Mapping[str, Any]]]) -> tuple[Table, Table]:
    """What was looked for in the residual, before and after: over all records, and record by record.

    residual : tests before and after. Of one record alone, its tests are those over all.
    """
    several = any(test["record"] == OVERALL for test in residual["after"])
    before = {(test["record"], test["test"]): test for test in residual["before"]}
    overall: list[list[str | Cell]] = []
    single: list[list[str | Cell]] = []
    for test in residual["after"]:
        name, first = test["test"].replace("-", " "), before.get((test["record"], test["test"]))
        of_all = test["record"] == OVERALL or not several
        (overall if of_all else single).append(
            [
                name if of_all else f"{test['record']}, {name}",
                Cell(probability(first["p_value"]) if first else NONE, "bad" if first and first["significant"] else ""),
                Cell(probability(test["p_value"]), "bad" if test["significant"] else ""),
                Cell(percent(test["share"], 2)),
                Cell(in_print(sentence(test["words"])), "prose"),
            ]
        )
    header = ["Looked for", "p before", "p after", "Of its variance", "After, in words"]
    note = "p corrected for all tests made, and for samples that are not independent."
    return (
        Table("Is there structure in the residual?", header, overall, note),
        Table("Record by record", header, single, note),
    )
