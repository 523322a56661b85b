"""The pictures of the structure tests: one for each test that the data allow, with its statistic and its p below."""

import re

import numpy as np
from matplotlib.colors import to_hex

from hysteresis_bench.diagnosis.structure.curves import read_curves, write_curves
from hysteresis_bench.diagnosis.structure.structure import structure
from hysteresis_bench.report.laws.maps import ABOVE, BELOW, scale, shades
from hysteresis_bench.report.laws.structure import structure_section
from hysteresis_bench.report.shared.page import Page
from tests.diagnosis.structure.made import minor_loops, plays, seen
from tests.report.links import parsed

UNITS = {"time": "s", "input": "V", "output": "um"}


def test_every_test_that_can_be_made_has_a_picture(tmp_path):
    found = structure(seen(plays(), minor_loops))
    write_curves(tmp_path, found.findings)
    told = [finding.as_dict() for finding in found.findings]
    section = structure_section(tmp_path, told, read_curves(tmp_path), UNITS)
    table, figures = section.blocks
    assert len(table.rows) == len(told)
    made = [finding for finding in found.findings if finding.applies]
    assert 1 < len(made) < len(told)
    assert [picture.caption.split(":")[0].lower() for picture in figures.pictures] == [one.name.lower() for one in made]
    for picture in figures.pictures:
        assert re.search(r"p [=<] [01]\.[0-9]+", picture.caption), picture.caption
        assert (tmp_path / picture.data).is_file()
        assert len(picture.inline) < 30_000
    page = Page("laws", "kicker", [section]).write(tmp_path / "page.html")
    assert len(parsed(page.read_text(encoding="utf-8")).ids) > 0


def test_a_diagnosis_of_before_there_were_curves_has_the_table_alone(tmp_path):
    told = [finding.as_dict() for finding in structure(seen(plays(), minor_loops)).findings]
    for finding in told:
        for key in ("refutes", "noise", "along"):
            del finding[key]
    assert len(structure_section(tmp_path, told, read_curves(tmp_path), UNITS).blocks) == 1


def test_the_shades_of_a_map_part_at_zero():
    for low, high in ((0.0, 3.0), (-2.0, 0.0), (-1.0, 4.0)):
        limits = scale(np.linspace(low, high, 200))
        assert 0.0 in limits
        assert limits[0] <= 0.98 * low
        assert limits[-1] >= 0.97 * high
        colours = shades(limits)
        hues = [to_hex(colour) for colour in colours]
        assert hues == [ABOVE if edge >= 0.0 else BELOW for edge in limits[:-1]]
        assert max(colour[3] for colour in colours) > 0.9
    assert set(scale(np.append(np.linspace(0.0, 3.0, 500), -50.0))) == set(scale(np.linspace(0.0, 3.0, 500)))
