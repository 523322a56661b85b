"""What could be read in two ways is read in the right one, or refused: thousands, clocks, and units that look alike."""

import numpy as np
import pandas as pd
import pytest

from hysteresis_bench import Layout, load
from hysteresis_bench.data.readers.numbers import number, seconds
from hysteresis_bench.data.units import converted, is_no_duration
from hysteresis_bench.errors import UserError


@pytest.mark.parametrize(
    ("text", "decimal", "value"),
    [
        ("0.123", ",", np.nan),
        ("12345.678", ",", np.nan),
        ("0,123", ".", np.nan),
        ("1.234", ",", 1234.0),
        ("-1.234.567,8e3", ",", -1234567.8e3),
        ("1.234'567", ",", np.nan),
        ("1,234.5", ".", 1234.5),
        ("1'234'567.5", ".", 1234567.5),
        ("2,3256", ",", 2.3256),
    ],
)
def test_only_a_group_of_thousands_is_one(text, decimal, value):
    assert number(text, decimal) == pytest.approx(value, nan_ok=True)


def test_a_point_beside_decimal_commas_is_a_fault(tmp_path):
    rows = [f"{k / 1000:.3f};{k:.4f};{2 * k:.4f}".replace(".", ",", 2) for k in range(1, 50)]
    rows = [row.replace(",", ".", 1) for row in rows]
    (tmp_path / "mixed.csv").write_text("\n".join(["time;input;output", *rows]), encoding="utf-8")
    with pytest.raises(UserError, match=r"0\.001"):
        load(tmp_path / "mixed.csv", layout=Layout(decimal=","))


@pytest.mark.parametrize(
    ("texts", "expected", "words"),
    [
        (["59:01", "59:02", "60:00"], [0.0, 1.0, 59.0], "minutes and seconds"),
        (["00:00", "00:01", "03:19"], [0.0, 60.0, 199 * 60.0], "times of day in hours and minutes"),
        (["59:01.5", "59:02.5"], [0.0, 1.0], "minutes and seconds"),
        (["23:59:59", "00:00:01"], [0.0, 2.0], "times of day"),
        (["11:59 PM", "12:01 AM"], [0.0, 120.0], "times of day"),
    ],
)
def test_a_clock_of_two_numbers(texts, expected, words):
    found, said = seconds(pd.Series(texts))
    assert found.tolist() == expected
    assert said == words


@pytest.mark.parametrize(
    ("unit", "wanted"),
    [
        ("rpm", "Hz"),
        ("Hz", "rad/s"),
        ("turn/s", "Hz"),
        ("A*turn", "A"),
        ("T", "A/m"),
        ("Oe", "T"),
        ("G", "A/m"),
        ("uC/cm^2", "kV/cm"),
        ("F", "cm"),
        ("ohm", "s/m"),
    ],
)
def test_what_only_looks_alike_is_refused(unit, wanted):
    with pytest.raises(ValueError, match="does not convert"):
        converted(np.ones(1), unit, wanted)


@pytest.mark.parametrize(
    ("unit", "wanted", "value"),
    [
        ("rpm", "rad/s", np.pi / 30.0),
        ("rpm", "deg/s", 6.0),
        ("deg", "rad", np.pi / 180.0),
        ("1/min", "Hz", 1.0 / 60.0),
        ("Oe", "A/m", 1e3 / (4.0 * np.pi)),
        ("A/m", "Oe", 4e-3 * np.pi),
        ("G", "T", 1e-4),
        ("%", "1", 0.01),
    ],
)
def test_what_is_one_quantity_converts(unit, wanted, value):
    assert converted(np.ones(1), unit, wanted)[0] == pytest.approx(value, rel=1e-9)


def test_an_angle_may_stand_for_a_time():
    assert not is_no_duration("deg")
    assert not is_no_duration("ms")
    assert is_no_duration("V")
