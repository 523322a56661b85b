"""What physics promises of Jiles-Atherton."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from hysteresis_bench.signals import Record, Signal
from hysteresis_plugins.models.jiles_atherton import JilesAtherton
from hysteresis_plugins.models.jiles_atherton_clamped import JilesAthertonClamped


def decades(lower: float, upper: float) -> st.SearchStrategy[float]:
    return st.floats(np.log(lower), np.log(upper)).map(lambda value: float(np.exp(value)))


# alpha is given as alpha M_s / min(3 a, k), below 1 where the equation is well-posed
points = st.tuples(
    st.floats(0.0, 0.9), decades(1.0, 100.0), decades(1.0, 100.0), decades(1e5, 1e7), st.floats(0.01, 1.0)
)


def values(point: tuple[float, ...]) -> SimpleNamespace:
    pull, a, k, M_s, c = point
    alpha = pull * min(3 * a, k) / M_s
    return SimpleNamespace(
        **{
            name: np.array([value])
            for name, value in zip(("alpha", "a", "k", "M_s", "c"), (alpha, a, k, M_s, c), strict=True)
        }
    )


def loop(samples: int, peak: float, harmonic: float, repeats: int) -> np.ndarray:
    """A closed loop, with minor loops where the harmonic is strong."""
    phase = 2 * np.pi * np.arange(repeats * samples + 1) / samples
    return peak * (np.sin(phase) + harmonic * np.sin(5 * phase))


@settings(max_examples=60, deadline=None)
@given(points, st.floats(1.0, 200.0), st.floats(0.0, 0.6))
def test_a_closed_loop_dissipates(point: tuple[float, ...], peak: float, harmonic: float) -> None:
    samples, repeats = 600, 6
    H = loop(samples, peak, harmonic, repeats)
    signal = Signal(np.arange(H.size, dtype=float), H[:, None])
    B = JilesAthertonClamped().simulate(signal, values(point))[:, 0]
    H, B = H[-samples - 1 :], B[-samples - 1 :]
    work = np.sum((H[1:] + H[:-1]) / 2 * np.diff(B))
    not_closed = abs(B[-1] - B[0]) * np.max(np.abs(H))
    assert work >= -not_closed - 1e-4 * np.ptp(H) * np.ptp(B)


@settings(max_examples=30, deadline=None)
@given(points, st.floats(1.0, 200.0), st.sampled_from([JilesAtherton, JilesAthertonClamped]))
def test_time_and_sign_do_not_enter(point: tuple[float, ...], peak: float, model: type[JilesAtherton]) -> None:
    """Rate independence, and B(-H) = -B(H)."""
    H = loop(300, peak, 0.3, 2)
    steady = np.arange(H.size, dtype=float)
    B = model().simulate(Signal(steady, H[:, None]), values(point))
    assert np.array_equal(B, model().simulate(Signal(steady**2 + 3.0, H[:, None]), values(point)))
    assert np.array_equal(-B, model().simulate(Signal(steady, -H[:, None]), values(point)))


def record(u: np.ndarray, y: np.ndarray) -> Record:
    return Record(np.arange(u.size, dtype=float), u, y)


@settings(max_examples=20, deadline=None)
@given(points, st.floats(20.0, 500.0))
def test_the_box_scales_with_the_units(point: tuple[float, ...], peak: float) -> None:
    """Millitesla and kA/m instead of T and A/m: the same box in the new units."""
    H = loop(300, peak, 0.0, 2)
    B = JilesAtherton().simulate(Signal(np.arange(H.size, dtype=float), H[:, None]), values(point))[:, 0]
    factor = {"alpha": 1e-3 / 1e3, "a": 1e-3, "k": 1e-3, "M_s": 1e3, "c": 1.0}
    for old, new in zip(
        JilesAtherton().box([record(H, B)]), JilesAtherton().box([record(H / 1e3, B * 1e3)]), strict=True
    ):
        assert not new.faults()
        assert np.isclose(new.lower, old.lower * factor[old.name])
        assert np.isclose(new.upper, old.upper * factor[old.name])


def test_advice() -> None:
    H = loop(400, 60.0, 0.0, 2)
    B = JilesAtherton().simulate(Signal(np.arange(H.size, dtype=float), H[:, None]), values((0.5, 6.0, 8.0, 2e6, 0.2)))[
        :, 0
    ]
    assert JilesAtherton().advice([record(H, B)]) == ()
    falling = JilesAtherton().advice([record(H, -B)])
    assert len(falling) == 1
    assert "--flip" in falling[0]
    shifted = JilesAtherton().advice([record(H + 60.0, B)])
    assert len(shifted) == 1
    assert "--input-offset" in shifted[0]
    assert JilesAtherton().advice([record(H + 60.0, H)]) == ()  # a straight line needs no centre
