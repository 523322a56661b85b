"""A fitted model's controllers, tuned on the model alone, on a rig that they can be run on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace

from hysteresis_bench.contracts import Plant, SteppedRig
from hysteresis_bench.control.closed_loop import Controller, Run, track
from hysteresis_bench.control.compensation import Forward
from hysteresis_bench.control.controllers.pi import ProportionalIntegral
from hysteresis_bench.control.controllers.sliding_mode import SlidingMode
from hysteresis_bench.control.controllers.tuning import tune_pi, tune_sliding_mode
from hysteresis_bench.control.observer import Differences, observer
from hysteresis_bench.control.references import Reference
from hysteresis_bench.control.suitability import check_units, range_words
from hysteresis_bench.control.trajectories.driven import forward_of
from hysteresis_bench.fit.model_file import FittedModel
from hysteresis_bench.fit.seeds import generator

UNKNOWN_ERROR = 0.01
"""Share of the amplitude taken for the model's RMSE where the model file has none."""

FEED_FORWARD, PI, PI_DYNAMIC = "feed-forward", "pi", "pi-dynamic"
SLIDING, LAYERED = "sliding-mode", "sliding-mode-layer"
IN_SERIES, PRINTED = "sliding-mode-series", "sliding-mode-printed"
MEANINGS = {
    FEED_FORWARD: "the static inverse alone: no sensor",
    PI: "the same feed-forward, and proportional and integral feedback",
    PI_DYNAMIC: "the same feedback, beside a feed-forward that also inverts the linear section, as (15) does",
    SLIDING: "ours: equation (15) with sgn, our observer, the inverse along the reference",
    LAYERED: "ours: the same with a boundary layer instead of sgn",
    IN_SERIES: "equation (15) with sgn, our observer, the inverse in series with it, as Figure 12 is drawn",
    PRINTED: "the paper's: equation (15) and Figure 12, the velocity from differences of the readings",
}


@dataclass(frozen=True, eq=False)
class Bench:
    """What can be run, and on what.

    name : of the rig
    controllers : that the model allows, by label;  tuning : their settings, by name
    told : what is odd about the rig's range, a sentence each
    """

    name: str
    plant: Plant
    limit: float
    forward: Forward
    controllers: Mapping[str, Controller]
    tuning: Mapping[str, Mapping[str, float]]
    told: tuple[str, ...]

    def run(self, label: str, reference: Reference, seed: int) -> Run:
        """One closed loop. The sensor's noise depends on seed, rig and reference: all controllers hear the same."""
        return track(
            self.plant,
            self.controllers[label],
            self.forward,
            reference=reference,
            limit=self.limit,
            rng=generator(seed, self.name, reference.name),
            series=label in (IN_SERIES, PRINTED),
        )


def bench_of(fitted: FittedModel, rig: SteppedRig, name: str, *, rate: float, amplitude: float) -> Bench:
    """rate : samples a second;  amplitude : of the references, in the output's unit

    Raises ValueError where units or ranges do not suit, the model has no inverse, its linear section is unstable, or
    the sampling is too slow.
    """
    forward = forward_of(fitted)
    check_units(fitted, forward, rig, name)
    told = tuple(range_words(fitted, forward, rig.input_limit, amplitude))
    controllers, tuning = _controllers(forward, 1.0 / rate, _model_error(fitted, amplitude))
    return Bench(name, rig.plant(rate), rig.input_limit, forward, controllers, tuning, told)


def _controllers(
    forward: Forward, interval: float, model_error: float
) -> tuple[dict[str, Controller], dict[str, dict[str, float]]]:
    pi = tune_pi(forward.linear, interval)
    feedback = ProportionalIntegral(forward.gain, pi.proportional, pi.integral, interval)
    controllers: dict[str, Controller] = {
        FEED_FORWARD: replace(feedback, proportional=0.0, integral=0.0),
        PI: feedback,
    }
    tuning = {PI: asdict(pi)}
    if forward.linear:
        found = tune_sliding_mode(forward.linear, interval, model_error)
        watching = observer(forward.linear, found.observer_bandwidth, interval)
        settings = (forward.linear, watching, found.convergence, found.epsilon, found.rho)
        sliding = controllers[SLIDING] = controllers[IN_SERIES] = SlidingMode(*settings)
        controllers[PRINTED] = replace(sliding, observer=Differences(interval))
        controllers[PI_DYNAMIC] = replace(feedback, linear=forward.linear)
        controllers[LAYERED] = replace(sliding, layer=found.layer)
        tuning[SLIDING] = asdict(found)
    return {label: controllers[label] for label in MEANINGS if label in controllers}, tuning


def _model_error(fitted: FittedModel, amplitude: float) -> float:
    rmse = (fitted.error.get("fitted") or {}).get("rmse")
    return float(rmse) if rmse else UNKNOWN_ERROR * amplitude
