"""Shortened figures: every point where it was, to a tenth of a point, and every mark in its style."""

import re

import numpy as np
import pytest

from hysteresis_bench.report.shared.short_svg import shortened
from hysteresis_bench.report.shared.theme import picture

STEP = re.compile(r"([Mlz])|(-?(?:\d+\.\d+|\d+|\.\d+))")


def points(path):
    """Absolute corners of a path of M and l."""
    found, command, numbers = [], "", []
    for letter, number in STEP.findall(path):
        command = letter or command
        numbers += [float(number)] if number else []
        if len(numbers) == 2:
            start = found[-1] if command == "l" else (0.0, 0.0)
            found.append((start[0] + numbers[0], start[1] + numbers[1]))
            numbers = []
    assert not numbers
    return np.array(found)


def test_a_long_line_keeps_every_point_and_loses_its_letters():
    rng = np.random.default_rng(1)
    drawn = np.cumsum(rng.normal(0.0, 3.0, (400, 2)), axis=0)
    d = "M " + " \nL ".join(f"{x:.6f} {y:.6f}" for x, y in drawn)
    short = shortened(f'<path d="{d} \n" style="fill: none"/>')
    found = points(re.search(r'd="([^"]*)"', short)[1])
    nearest = np.abs(found[None, :, :] - drawn[:, None, :]).max(axis=2).min(axis=1)
    assert nearest.max() <= 0.05 + 1e-9
    assert len(short) < 0.45 * len(d)


@pytest.mark.parametrize(
    ("path", "wanted"),
    [
        ("M 1.04 2 \nL 1.96 2.1 \nL 1.96 2.1 \n", "M1 2l1 .1"),
        ("M 0 0 \nL -0.5 -10 \nL 0 0 \nz\n", "M0 0l-.5-10 .5 10z"),
        ("M 5 5 \nL 5.01 5.01 \n", "M5 5l0 0"),
        ("M 0 0 \nL 1 1 \nM 10 10 \nL 11 11 \n", "M0 0l1 1M10 10l1 1"),
        ("M 0 1.5 \nC 0.397805 1.5 0.77937 1.341951 1 1 \nz\n", "M 0 1.5 C 0.40 1.5 0.78 1.34 1 1 z"),
        ("M 1e-7 3 \nL 2 3 \n", "M0 3l2 0"),
    ],
)
def test_paths(path, wanted):
    assert shortened(f'<path d="{path}"/>') == f'<path d="{wanted}"/>'


def test_marks_of_one_style_say_it_once():
    marks = [
        f'     <use xlink:href="#m" x="{x}.123" y="7.96" style="fill: {colour}"/>' for x, colour in enumerate("aab")
    ]
    found = shortened("<g>\n" + "\n".join(marks) + "\n</g>")
    assert found.count('style="fill:a"') == 1
    assert '<g style="fill:a">\n<use xlink:href="#m" x=".1" y="8"/>' in found
    assert found.count("<use") == 3


def test_names_that_nothing_refers_to_are_left_out_and_places_are_short():
    text = '<text x="138.046875" transform="translate(-1.2345 7)">1.2345</text></g>'
    wanted = '<text x="138.05" transform="translate(-1.23 7)">1.2345</text></g>'
    assert shortened(f'<g id="a"><g id="b" clip-path="url(#p)"/>{text}') == f'<g><g clip-path="url(#p)"/>{wanted}'


def test_a_figure_is_drawn_from_it(tmp_path):
    def draw(figure):
        axes = figure.add_subplot()
        axes.plot([0, 1, 2], [1e-3, 5.0, 1.0], "o-")
        axes.set_yscale("log")

    drawn = picture(tmp_path, "f", (3, 2), alt="a", caption="c", draw=draw)
    file = (tmp_path / "figures" / "f.svg").read_text(encoding="utf-8")
    assert file.startswith("<?xml")
    assert file.rstrip().endswith("</svg>")
    assert drawn.inline.count("<use") == file.count("<use") > 3
