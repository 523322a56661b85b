"""Are law and effect found where neither is known, and the effect has another formula than the program's?

    python benchmarks/law_beside_other_effects.py [LAW ...] [--first N] [--count N] [--hide N] [--timeout SECONDS]

`diagnose` without a model, on data of the rig `hidden-effects`: every law hides `--hide` effects by formulas of the
field that the program's own cannot reproduce, in draws `--first` and on; four records are fitted, one is held out, one
is neither. The noise is drawn between 0.2 and 1 % of the range. Told are the law that is found, what is claimed, and
what is left of the records that were not fitted, over the noise.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import pandas as pd
from limited import limited

from hysteresis_bench.diagnosis_study.case import Case, CaseTicket, run_case
from hysteresis_bench.diagnosis_study.study_file import BenchSpec, DiagnosisStudy

LAWS = ("bouc-wen", "dahl", "energy-based", "ferroelectric", "jiles-atherton", "prandtl-ishlinskii-modified")


def ticket(law: str, hide: int, number: int) -> CaseTicket:
    bench = BenchSpec(
        name=law,
        rig="hidden-effects",
        settings={"model": law, "hide": hide, "other": True},
        vary="draw",
        model="",
        fitted=["slow", "fast", "nested", "sweep"],
        held_out=["mixed"],
        fresh=["stairs"],
        first=number,
    )
    study = DiagnosisStudy(kind="diagnosis", title="law beside other effects", seed=0, bench=[bench])
    return CaseTicket(study.model_dump_json(), law, number)


def row(law: str, case: Case) -> dict[str, object]:
    return {
        "made by": law,
        "draw": case.number,
        "hidden": case.hidden or "none",
        "found": case.model,
        "claimed": case.claimed or "none",
        "law": case.model == law,
        "effect": case.right_by_family,
        "held out / noise": case.after,
        "fresh / noise": case.fresh,
        "verdict": case.verdict,
        "seconds": case.seconds,
    }


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("laws", nargs="*")
    parser.add_argument("--first", type=int, default=51877)
    parser.add_argument("--count", type=int, default=1)
    parser.add_argument("--hide", type=int, default=1)
    parser.add_argument("--timeout", type=int, default=600)
    given = parser.parse_args(arguments)
    rows = []
    for number in range(given.first, given.first + given.count):
        for law in given.laws or LAWS:
            try:
                with limited(given.timeout):
                    rows.append(row(law, run_case(ticket(law, given.hide, number))))
            except TimeoutError:
                rows.append({"made by": law, "draw": number, "law": False, "effect": False, "verdict": "too late"})
            print(", ".join(f"{key}: {value}" for key, value in rows[-1].items()), flush=True)
    table = pd.DataFrame(rows)
    print(
        f"law right in {table['law'].sum()} of {len(table)}, effects or their families in {table['effect'].sum()}, "
        f"both in {(table['law'] & table['effect']).sum()}"
    )
    if "seconds" in table:
        print(f"median {table['seconds'].median():.0f} s, worst {table['seconds'].max():.0f} s")


if __name__ == "__main__":
    main()
