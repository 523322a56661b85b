"""Which records were rounded as they were measured, and which were made on a grid."""

from __future__ import annotations

import numpy as np
import pytest

from hysteresis_bench.kernels.value_grid import grid_step, rounded_to

TIME = np.arange(1800) / 300.0
SINE = 2.0 * np.sin(np.pi * TIME)
TONES = 1.5 * np.sin(2.0 * np.pi * 0.7 * TIME) + np.sin(2.0 * np.pi * 2.3 * TIME + 1.0)
SWEEP = 1.5 * np.sin(2.0 * np.pi * (0.5 + 0.4 * TIME) * TIME)
WHOLE = np.arange(1800)
LEVELS = np.random.default_rng(1).integers(-30, 31, 60)
COMMANDS = {
    "stairs": 0.1 * np.repeat(LEVELS, 30),
    "short stairs": 0.1 * np.repeat(LEVELS[:45], 40)[np.arange(1800) * 4 % 1800],
    "a triangle": 0.05 * np.abs(WHOLE % 240 - 120),
    "a trapezoid": 0.05 * np.clip(np.abs(WHOLE % 240 - 120), 20, 90),
    "a random telegraph": 0.5 * np.repeat(np.sign(np.random.default_rng(2).normal(size=225)), 8),
    "a constant": np.full(1800, 0.3),
}


@pytest.mark.parametrize("step", [0.002, 0.01, 0.05])
@pytest.mark.parametrize("course", [SINE, TONES, SWEEP], ids=["sine", "tones", "sweep"])
def test_an_encoder_is_told(course, step):
    rounded = np.rint(course / step) * step
    assert grid_step(rounded) == pytest.approx(step)
    assert rounded_to(rounded) == pytest.approx(step)
    assert rounded_to(course) == 0.0


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_a_command_on_a_grid_was_not_rounded(command):
    assert rounded_to(command) == 0.0
