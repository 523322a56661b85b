"""A model and a rig: the unit of time counts wherever the model knows a time, and what cannot be run is refused."""

from dataclasses import replace

import pytest

from hysteresis_bench.control.bench import bench_of
from hysteresis_bench.control.comparison import compare
from hysteresis_bench.control.trajectories.sweep import sweep
from hysteresis_bench.errors import UserError
from hysteresis_bench.fit.model_file import Estimate
from tests.control.test_control import UNITS, StandIn, model

SLOW = UNITS | {"time": "ms"}
LAG = {"input-lag.time_constant": Estimate(2.0, None, "ms")}


def with_lag():
    bare = replace(model("bouc-wen"), effects=("input-lag",), effect_settings={"input-lag": {}}, units=SLOW)
    return replace(bare, parameters={**bare.parameters, **LAG})


def refused(fitted):
    with pytest.raises(ValueError, match="time is in ms in the model and in s on the rig stand-in") as told:
        bench_of(fitted, StandIn(), "stand-in", rate=2000.0, amplitude=1.0)
    return str(told.value)


def test_a_lag_in_ms_is_refused_on_a_rig_in_s():
    assert refused(with_lag()).endswith("Fit the model to data in the rig's units.")


def test_a_lag_that_was_given_is_refused_as_one_that_was_found():
    found = {name: one for name, one in with_lag().parameters.items() if name not in LAG}
    refused(replace(with_lag(), parameters=found, fixed={"input-lag.time_constant": 2.0}))


def test_a_law_without_a_time_may_be_fitted_in_any():
    assert bench_of(replace(model("bouc-wen"), units=SLOW), StandIn(), "stand-in", rate=2000.0, amplitude=1.0)


@pytest.mark.parametrize("rate", [float("nan"), float("inf"), -1.0, 1.0])
def test_a_rate_that_cannot_be_is_refused(rate):
    with pytest.raises(ValueError, match=r"a rate of .* choose one from 200 to 1e\+06 samples a second"):
        compare(model("bouc-wen"), StandIn(), "stand-in", rate=rate)


@pytest.mark.parametrize("amplitude", [float("nan"), float("inf"), 0.0])
def test_an_amplitude_that_cannot_be_is_refused(amplitude):
    with pytest.raises(ValueError, match="choose a finite one above 0"):
        compare(model("bouc-wen"), StandIn(), "stand-in", amplitude=amplitude)


def test_a_sweep_tells_all_that_cannot_be():
    with pytest.raises(UserError) as told:
        sweep(model("bouc-wen"), (1e300, 1.0, float("nan")), (float("inf"), 1.0))
    assert told.value.faults == [
        "a frequency of 1e+300 cannot be; choose one from 1e-09 to 1e+09 cycles a unit of the model's time.",
        "a frequency of nan cannot be; choose one from 1e-09 to 1e+09 cycles a unit of the model's time.",
        "an amplitude of inf cannot be; choose one from 1e-30 to 1e+30.",
    ]
