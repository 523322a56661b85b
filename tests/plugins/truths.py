"""Laws on data of their own: what is linear is solved for, what is not is given."""

from __future__ import annotations

import numpy as np

from hysteresis_bench.compose import System
from hysteresis_bench.signals import Record

TIME = np.linspace(0.0, 6.0, 1501)


def waves(amplitude=1.0, centre=0.0):
    """An input whose swings differ, (samples,)."""
    return centre + amplitude * np.sin(2 * np.pi * TIME) * (1.0 - 0.12 * TIME)


def simulated(model, u, time=TIME, **values):
    """The output of one particle, (samples,)."""
    values = np.array([[values[q.name]] for q in model.parameters])
    return System(model).simulate(Record(time, u, None).signal, values)[:, 0]


def record(model, u, **values):
    return Record(TIME, u, simulated(model, u, **values))


def solved(model, one, **known):
    """The linear parameters that fit a record best, by name; known : the others."""
    names = list(model.linear)
    none = {**known, **dict.fromkeys(names, 0.0)}
    base = simulated(model, one.input, **none)
    columns = [simulated(model, one.input, **{**none, name: 1.0}) - base for name in names]
    found = np.linalg.lstsq(np.stack(columns, axis=1), one.output - base, rcond=None)[0]
    return dict(zip(names, found.tolist(), strict=True))


def held(model, records, values):
    """Names of parameters that lie outside the box of these records."""
    return [q.name for q in model.box(records) if not q.lower <= values[q.name] <= q.upper]


def assert_found_again(law, known, linear):
    """The linear parameters are solved for to the truth, which lies in the box that the record gives."""
    one = record(law, waves(), **known, **linear)
    found = solved(law, one, **known)
    np.testing.assert_allclose([found[name] for name in linear], list(linear.values()), rtol=1e-6)
    assert not held(law, [one], {**known, **linear})
