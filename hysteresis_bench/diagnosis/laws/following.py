"""Does a fitted law follow its data? A sentence where it does not, with what the data say of it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hysteresis_bench.data.units import rounded
from hysteresis_bench.diagnosis.evidence.noise import pooled_noise
from hysteresis_bench.diagnosis.evidence.noise_floor import WRONG, floor_of
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.laws.exclusion import why_not
from hysteresis_bench.diagnosis.preparation import thinned
from hysteresis_bench.diagnosis.question import record_faults
from hysteresis_bench.diagnosis.search.follows import EXPLAINED
from hysteresis_bench.diagnosis.structure.structure import structure
from hysteresis_bench.signals import Record


def cannot_follow(model: str, effects: Sequence[str], records: Sequence[Record], rmse: float) -> tuple[str, ...]:
    """No sentence where the error is near the noise, or where the records tell too little of it.

    Where less than EXPLAINED of the variance is explained, this is what is told: the noise is as large as all else.

    model, effects : what was fitted;  records : to which, as the model sees them;  rmse : over all of them
    """
    variance = np.concatenate([record.measured - record.measured.mean() for record in records]).var()
    explained = 1.0 - rmse**2 / float(variance)
    much = f"{100 * explained:.2g} %" if explained > 0.0 else "nothing"
    unrelated = (
        f"The output does not follow the input: {model} explains {much} of its variance. Do these columns belong "
        "together, and is the input the one that drives the device?"
    )
    told = (unrelated,) if explained < EXPLAINED else ()
    if record_faults(records, "judge"):
        return told
    views = views_of(records)
    floor = floor_of(views, pooled_noise([view.noise for view in views]))
    if rmse <= WRONG * floor:
        return told
    why = why_not(model, structure(views_of(thinned(views))), rmse)
    around = f" with {', '.join(effects)}" if effects else ""
    off = f"This law cannot follow these data: {model}{around} leaves {rounded(rmse / floor)} times the noise."
    return (*told, f"{off} {why or 'No structure test says why; `diagnose` looks for an effect that is missing.'}")
