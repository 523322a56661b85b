"""What the small pictures show: alike branches lie on each other, others do not, and a file keeps them."""

from __future__ import annotations

import numpy as np
import pytest

from hysteresis_bench.diagnosis.structure.curves import MOST, read_curves, write_curves
from hysteresis_bench.diagnosis.structure.structure import structure
from tests.diagnosis.structure.made import late, minor_loops, modulated, plays, seen, sine

LEVEL = 0.002


def bent(time: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Plays behind a curve: neither odd nor of Masing's rule."""
    y = plays()(time, u)
    return y + 0.3 * y**2 / np.max(np.abs(y))


def spread(curves) -> float:
    """RMS by which curves differ where they are read at the same places, over their range."""
    found: dict[float, list[float]] = {}
    for curve in curves:
        for x, y in zip(curve.x, curve.y, strict=True):
            found.setdefault(round(float(x), 9), []).append(float(y))
    left = np.concatenate([np.array(values) - np.mean(values) for values in found.values() if len(values) > 1])
    return float(np.sqrt(np.mean(left**2)) / np.ptp([y for curve in curves for y in curve.y]))


def test_branches_of_masings_rule_are_moved_onto_each_other():
    law, other = (structure(seen(made, modulated, level=LEVEL)).of("Masing's rule") for made in (plays(), bent))
    assert 1 < len(law.curves) <= MOST
    assert spread(law.curves) < 2.0 * LEVEL
    assert spread(other.curves) > 3.0 * spread(law.curves)
    assert max(np.abs(curve.apart).max() for curve in other.curves) > other.statistic


def test_the_output_turns_when_it_does():
    for made, is_late in ((plays(), False), (late(), True)):
        turned = {curve.name: curve for curve in structure(seen(made, sine)).of("reversal lag").curves}
        when = {name: float(curve.x[np.argmax(curve.y)]) for name, curve in turned.items()}
        assert (when["output"] > when["input"]) == is_late


def test_the_curves_of_the_worst_group_are_shown():
    found = structure(seen(bent, modulated, level=LEVEL)).of("Masing's rule")
    assert found.refutes
    shown = np.concatenate([curve.apart for curve in found.curves])
    assert np.sqrt(np.mean(shown**2)) >= 0.9 * found.statistic


def test_a_file_keeps_them(tmp_path):
    found = structure(seen(plays(), minor_loops))
    write_curves(tmp_path, found.findings)
    kept = read_curves(tmp_path)
    assert kept.keys() == {finding.name for finding in found.findings if finding.curves}
    for finding in found.findings:
        for one, again in zip(finding.curves, kept.get(finding.name, []), strict=True):
            for part in ("x", "y", "apart"):
                assert getattr(again, part) == pytest.approx(getattr(one, part), rel=1e-5)
    assert read_curves(tmp_path / "nowhere") == {}
