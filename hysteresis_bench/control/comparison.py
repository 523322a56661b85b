"""Six references, every controller, one rig: who follows best, at what chatter, and what the floor is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from typing import Any

import pandas as pd

from hysteresis_bench import registry
from hysteresis_bench.contracts import SteppedRig
from hysteresis_bench.control.bench import bench_of
from hysteresis_bench.control.closed_loop import Run
from hysteresis_bench.control.compensation import Forward
from hysteresis_bench.control.references import published_references
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.kernels.resources import economical
from hysteresis_bench.progress import OnStep, Step, quiet

SLOWEST, FASTEST = 200.0, 1e6
"""Samples a second of references that turn up to 50 times a second and last up to six."""
RATE = 10_000.0
"""Samples a second where none are asked for."""
AMPLITUDE = 2.0
"""Of the references where none is asked for, unit of the output. Ours."""
SHOWN = 1000
"""Samples of a run that are kept for figures."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """What a comparison found.

    scores : reference, controller, then the scores of a run, noise_floor, delay_floor, unit
    responses : reference, controller, time, wanted, displacement, voltage, error; thinned to SHOWN samples a run
    tuning : settings of every controller by name
    """

    scores: pd.DataFrame
    responses: pd.DataFrame
    tuning: Mapping[str, Mapping[str, float]]
    units: Mapping[str, str]
    conditions: Mapping[str, Any]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]

    def _repr_html_(self) -> str:
        """For a notebook: the RMS tracking error, references by controllers, and the warnings."""
        table = self.scores.pivot_table(index="reference", columns="controller", values="t_rmse", sort=False)
        sentences = "".join(f"<p>{escape(warning)}</p>" for warning in self.warnings)
        return f"<p>RMS tracking error, {self.units['output']}</p>{table.to_html(float_format='%.4g')}{sentences}"


def stepped_rig(name: str, settings: Mapping[str, Any] | None = None) -> SteppedRig:
    """A registered rig that can be run sample by sample. Raises ValueError where it cannot, or where it is none."""
    rig = registry.build("rigs", name, settings)
    if isinstance(rig, SteppedRig):
        return rig
    loaded = {each: registry.load("rigs", each).loaded for each in registry.names("rigs")}
    able = [each for each, one in loaded.items() if one and issubclass(one, SteppedRig)]
    raise ValueError(f"rig {name} cannot be run sample by sample. These can: {', '.join(able) or 'none'}.")


@economical()
def compare(
    fitted: FittedModel,
    rig: SteppedRig,
    name: str,
    *,
    rate: float = RATE,
    amplitude: float = AMPLITUDE,
    seed: int = 0,
    on_step: OnStep = quiet,
) -> Comparison:
    """Run every controller that the model allows along every reference, on the rig.

    name : of the rig
    rate : samples a second;  amplitude : of the references, in the output's unit
    The sensor's noise depends on seed, rig and reference, so that all controllers hear the same.
    Raises ValueError where rate or amplitude cannot be, units or ranges do not suit, the model has no inverse, its
    linear section is unstable, or the sampling is too slow.
    """
    if not SLOWEST <= rate <= FASTEST:
        told = "more samples than can be held" if rate > FASTEST else "too few samples for the references"
        raise ValueError(f"a rate of {rate:g} is {told}; choose one from {SLOWEST:g} to {FASTEST:g} samples a second.")
    if not 0.0 < amplitude < float("inf"):
        raise ValueError(f"an amplitude of {amplitude:g} cannot be followed; choose a finite one above 0.")
    on_step(Step("tuning"))
    bench = bench_of(fitted, rig, name, rate=rate, amplitude=amplitude)
    scores: list[dict[str, Any]] = []
    responses = []
    references = published_references(amplitude, rate)
    for reference in references:
        for label in bench.controllers:
            on_step(Step("references by controllers", len(scores), len(references) * len(bench.controllers)))
            run = bench.run(label, reference, seed)
            key = {"reference": reference.name, "controller": label}
            floors = {"noise_floor": rig.noise_floor, "delay_floor": reference.delay_floor}
            scores.append(key | run.scores() | floors | {"unit": fitted.units["output"]})
            responses.append(course(run).assign(**key))
    table = pd.DataFrame(scores)
    conditions = {"rig": name, "rate": rate, "amplitude": amplitude, "seed": seed, "voltage_limit": rig.input_limit}
    warnings = (*bench.told, *_warnings(table, bench.forward, fitted))
    notes = NOTES if bench.forward.linear is None else (*NOTES, *OF_THE_PAPER)
    return Comparison(table, pd.concat(responses), bench.tuning, fitted.units, conditions, notes, warnings)


def course(run: Run) -> pd.DataFrame:
    """time, wanted, displacement, voltage, error, where it is scored, thinned to SHOWN samples."""
    scored = slice(run.reference.history, None, max(1, run.error.size // SHOWN))
    wanted, reached = run.reference.position[scored], run.displacement[scored]
    columns = {"time": run.reference.time[scored], "wanted": wanted, "displacement": reached}
    return pd.DataFrame(columns | {"voltage": run.voltage[scored], "error": wanted - reached})


NOTES = (
    "T_error and T_rmse are the largest and the RMS error of the true displacement; what the sensor sees is beside "
    "them. Total variation sums every change of the voltage: chatter shows there first.",
    "The noise floor is the RMS of what the sensor adds; feedback cannot hear less than that in one sample, only "
    "average it. The delay floor is the RMS error of an output that is perfect but one sample late; a reference "
    "that is known ahead can be followed more closely.",
    "The tuning uses the identified model alone, never the rig: the strongest feedback whose largest amplification "
    "of a disturbance stays below 2, with two samples of lag to spare.",
    "The feed-forward is the exact inverse of the discrete model.",
)
OF_THE_PAPER = (
    "The published values of C, epsilon and rho repeat those of the Bouc-Wen model and cannot be the controller's.",
    "Equation (14), read with the paper's own names (u0 the reference), is the forward model; with the names exchanged "
    "it is the inverse, and implicit.",
    "Figure 12 puts the inverse in series with the feedback law. A Bouc-Wen model forgets its hysteresis along every "
    "small reversal, so a law that chatters wipes out the compensation: see sliding-mode-printed, which adds nothing "
    "to (15) and Figure 12, and sliding-mode-series, with our observer. The others run the inverse along the "
    "reference, and convert what feedback adds with the model's slope at h = 0.",
)


def _warnings(scores: pd.DataFrame, forward: Forward, fitted: FittedModel) -> list[str]:
    sentences, cut = [], scores[scores["saturated_share"] > 0]
    if len(cut):
        worst = cut.loc[cut["saturated_share"].idxmax()]
        sentences.append(
            f"The voltage limit cut samples in {len(cut)} of {len(scores)} runs, at worst "
            f"{100 * worst['saturated_share']:.1f} % of them ({worst['controller']} on {worst['reference']})."
        )
    if fitted.preparation.settle or fitted.preparation.skip:
        sentences.append("The fit scored no run-in of its records; on the rig every reference begins at rest.")
    if forward.ignored:
        sentences.append(f"Effects of the model that are not inverted: {', '.join(forward.ignored)}.")
    if forward.linear is None:
        sentences.append(
            "The model has no linear section: there is nothing for a sliding mode to work on, and the PI is cautious "
            f"because the model does not know where the actuator resonates. Fit {registry.HAMMERSTEIN} for both."
        )
    return sentences
