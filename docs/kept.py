"""What the kept results say: numbers that pages cite, read from results/ whenever the pages are built."""

from __future__ import annotations

import importlib
import json
import tomllib
from pathlib import Path
from typing import Any

import pandas as pd

from docs.registry_pages import table

RESULTS = Path(__file__).parents[1] / "results"
MODELS_OWN_RIG = "hidden-effects"
"""The rig whose hysteresis is a model's own."""

PREDICTED = 1.15
"""RMSE over noise up to which a record counts as predicted."""


def constant(module: str, name: str) -> Any:
    """A number that the program decides by, from where it decides. Raises AttributeError where it is gone."""
    return getattr(importlib.import_module(f"hysteresis_bench.{module}"), name)


def summary(study: str, problem: str) -> pd.DataFrame:
    """The rows of a study's summary.csv on one problem, the best first. Raises KeyError where there are none."""
    rows = pd.read_csv(RESULTS / study / "summary.csv")
    rows = rows[rows["problem"] == problem]
    if rows.empty:
        raise KeyError(f"{study} has no problem {problem!r}")
    return rows.set_index("optimizer", drop=False)


def always(study: str, problem: str) -> str:
    """How many optimizers succeed in every trial, as "15 of 26"."""
    rows = summary(study, problem)
    return f"{int((rows['success_rate'] == 1.0).sum())} of {len(rows)}"


def verdict(study: str, problem: str, optimizer: str) -> str:
    """What the study says of an optimizer beside its reference."""
    return str(summary(study, problem).at[optimizer, "verdict_reference"])


def claims(study: str) -> str:
    """A table of a paper's claims and of our ablations: verdict, A12, probability that both are equivalent."""
    rows = pd.read_csv(RESULTS / study / "claims.csv")
    return table(
        ["claim", "problem", "verdict", "A12 (95 %)", "equivalent", "over"],
        [
            (
                row["claim"],
                row["problem"],
                f"**{row['verdict']}**",
                f"{row['a12']:.2f} ({row['a12_low']:.2f} to {row['a12_high']:.2f})",
                "–" if pd.isna(row["probability_equivalent"]) else f"{row['probability_equivalent']:.2f}",
                row["over"],
            )
            for _, row in rows.iterrows()
        ],
    )


def optimizers(study: str, problem: str, first: int = 6, also: tuple[str, ...] = ()) -> str:
    """A table of the first few optimizers, and of those named."""
    rows = summary(study, problem)
    shown = [*rows.index[:first], *(name for name in also if name not in rows.index[:first])]
    return table(
        ["optimizer", "successes", "median relative RMS", "evaluations to a success", "seconds a trial"],
        [
            (
                f"`{name}`",
                f"{row['successes']} of {row.get('counted', row['trials'])}",
                f"{row['relative_rms_median']:.4g}",
                f"{row['expected_running_time']:.0f}" if row["successes"] else "none succeeded",
                f"{row['seconds_median']:.2g}",
            )
            for name, row in ((name, rows.loc[name]) for name in shown)
        ],
    )


def determined(study: str, problem: str) -> str:
    """What a study's data determine of a model's parameters, in sentences."""
    content = json.loads((RESULTS / study / "identifiability.json").read_text(encoding="utf-8"))
    return " ".join(content[problem]["sentences"])


def closing(study: str) -> dict[str, Any]:
    """The diagnosis at the end of a study: its effects, verdict, errors over the noise, advice."""
    found = json.loads((RESULTS / study / "closing" / "diagnosis.json").read_text(encoding="utf-8"))
    noise = found["noise_rms"]
    return {
        "model": found["model"],
        "verdict": found["verdict"],
        "effects": ", ".join(f"`{name}`" for name in found["effects"]) or "none",
        "before": f"{found['before']['held_out']['rmse'] / noise:.3g}",
        "after": f"{found['after']['held_out']['rmse'] / noise:.3g}",
        "advice": found["advice"],
    }


def closings(*studies: str) -> str:
    """A table of the diagnoses at the end of studies."""
    rows = []
    for study in studies:
        found = closing(study)
        rows.append((f"`{study}`", f"`{found['model']}`", found["effects"], found["before"], found["after"]))
    return table(["study", "model", "effects adopted", "held out before", "held out after"], rows)


def cases(study_of_diagnosis: str = "closing_the_loop") -> pd.DataFrame:
    """The finished cases of a study of diagnosis; `known` where the hysteresis is a model's own."""
    folder = RESULTS / study_of_diagnosis
    study = tomllib.loads((folder / "study.toml").read_text(encoding="utf-8"))
    rigs = {bench["name"]: bench["rig"] for bench in study["bench"]}
    rows = pd.read_csv(folder / "cases.csv", keep_default_na=False, na_values={"fresh": [""], "after": [""]})
    rows = rows[rows["status"] == "done"]
    judged = {name: rows[name].astype(str) == "True" for name in ("right", "right_by_family")}
    return rows.assign(known=rows["bench"].map(rigs) == MODELS_OWN_RIG, **judged)


def named(known: bool) -> str:
    """Cases with something hidden in which all of it was named or tied, and nothing else, as "151 of 155"."""
    rows = cases()
    rows = rows[(rows["known"] == known) & (rows["hidden"] != "")]
    return f"{int(rows['right'].sum())} of {len(rows)}"


def claimed_on_clean(known: bool) -> str:
    """Cases with nothing hidden in which something was claimed, as "0 of 50"."""
    rows = cases()
    rows = rows[(rows["known"] == known) & (rows["hidden"] == "")]
    return f"{int((rows['claimed'] != '').sum())} of {len(rows)}"


def predicted() -> str:
    """Cases whose fresh records were predicted to within PREDICTED times the noise, as "202 of 205"."""
    fresh = cases()["fresh"].dropna()
    return f"{int((fresh <= PREDICTED).sum())} of {len(fresh)}"


def known_cases() -> int:
    """Cases whose hysteresis is a model's own."""
    return int(cases()["known"].sum())


def mistakes() -> str:
    """A table of the cases with known truth that went wrong."""
    rows = cases()
    rows = rows[rows["known"] & ~rows["right"]]
    return table(
        ["case", "hidden", "claimed"],
        [(f"{r.bench}, {r.number}", _listed(r.hidden), _listed(r.claimed)) for r in rows.itertuples()],
    )


def on_rigs() -> str:
    """A table of the virtual rigs: right cases, median errors over the noise."""
    rows = cases()
    rows = rows[~rows["known"]]
    found = []
    for bench, group in rows.groupby("bench", sort=False):
        before, after = (pd.to_numeric(group[name]).median() for name in ("before", "after"))
        found.append((bench, f"{int(group['right'].sum())} of {len(group)}", f"{before:.3g}", f"{after:.3g}"))
    return table(["rig and what is hidden", "right", "held out before", "held out after"], found)


def measurements() -> pd.DataFrame:
    """The diagnoses of real measurements, by case."""
    rows = pd.read_csv(RESULTS / "real-measurements" / "numbers.csv", keep_default_na=False)
    return rows.set_index("case", drop=False)


def measured() -> str:
    """A table of the diagnoses of real measurements; errors over the noise."""
    rows = measurements()
    return table(
        ["records", "model", "effects adopted", "held out before", "held out after", "verdict"],
        [
            (
                row["case"],
                f"`{row['model']}`",
                _listed(row["effects"]),
                f"{row['held_out_before'] / row['noise']:.3g}",
                f"{row['held_out_after'] / row['noise']:.3g}",
                row["verdict"],
            )
            for _, row in rows.iterrows()
        ],
    )


def measurement(case: str, column: str) -> Any:
    """One number or sentence of a diagnosed measurement."""
    return measurements().at[case, column]


def law(device: str, column: str) -> Any:
    """One number of the law that was chosen for a measured device."""
    laws = pd.read_csv(RESULTS / "real-measurements" / "laws.csv").set_index("device")
    return laws.at[device, column]


def unexplained() -> str:
    """Measurements in which something is left that no effect explains, as "12 of 12"."""
    rows = measurements()
    return f"{int((rows['verdict'] == 'unexplained-residual').sum())} of {len(rows)}"


def _listed(names: str) -> str:
    return ", ".join(f"`{name}`" for name in names.split()) or "nothing"
