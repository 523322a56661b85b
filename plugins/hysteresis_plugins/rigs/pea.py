"""Piezoelectric actuator rig: voltage in, displacement of a flexure-guided stage out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import DrivenRig, Range, SteppedRig
from hysteresis_bench.signals import Dataset, Record

if TYPE_CHECKING:
    from hysteresis_plugins.rigs._pea_kernel import Physics

AMPLITUDE = 2.5  # V; ours: [PEA] prints none. Its loop of 0.54 um (2 alpha d / (beta + gamma)) is 10 % of this stroke
SAMPLES = 6000  # [PEA] section 3.1
PLAYS = 60  # ours: more change the displacement by less than the sensor resolves


@dataclass(frozen=True)
class PeaRig(DrivenRig, SteppedRig):
    """A piezoelectric stack moves a flexure-guided stage; voltage and displacement count from mid-range.

    Built after the bench of [PEA] (section 4.1: a P11-X100S actuator with a strain gauge, an amplifier, a data
    acquisition card). The paper gives the sensor and the identified models, and no data.

    Amplifier: a first-order lag into the capacitance of the stack.
    Ceramic: rate-independent, with non-local memory. A Prandtl-Ishlinskii population of play operators whose
    half widths are distributed exponentially [K], then a slight saturation and asymmetry of the whole.
    It is depolarised at 0 V when a record begins. So minor loops close, and the past that a reversal
    uncovers comes back, which no Bouc-Wen model can do.
    Creep: logarithmic in time [J]: one relaxing element a decade, from 0.1 s to 1000 s.
    Stage: mass, flexure spring and damper, of the published resonance and damping.
    Sensor: normal noise, then rounding to its resolution.

    Settings are V, um, s, Hz. Effects are switched off by hysteresis, saturation, asymmetry, creep, bandwidth,
    natural_frequency, noise or resolution = 0. Raises ValueError that tells all settings that make no rig.

    The gain, the stage's resonance and damping are [PEA]'s own results, and hysteresis and half_width were chosen so
    that its alpha, beta and gamma come near: a fit that finds the paper's values here proves nothing. `ranges` says how
    far each differs from one actuator to the next.

    [PEA] the PEA paper: particle swarm genetic hybrid, Hammerstein model
    [K] Kuhnen, Eur. J. Control 9 (2003) 407-418: the Prandtl-Ishlinskii approach
    [J] Jung and Gweon, Rev. Sci. Instrum. 71 (2000) 1896-1900: creep of piezoelectric actuators
    """

    units: ClassVar[Mapping[str, str]] = MappingProxyType({"time": "s", "input": "V", "output": "um"})
    experiments: ClassVar[dict[str, str]] = {
        "static-sine": "3 periods of 0.5 Hz, 2.5 V, 6000 samples",
        "sweep": "0.1 to 50 Hz within 10 s, 2.5 V, 20 000 samples",
        "sine-10-hz": "12 periods, 2.5 V, 6000 samples",
        "sine-20-hz": "24 periods, 2.5 V, 6000 samples",
        "sine-30-hz": "36 periods, 2.5 V, 6000 samples",
        "sine-40-hz": "48 periods, 2.5 V, 6000 samples",
        "sine-50-hz": "60 periods, 2.5 V, 6000 samples",
        "damped-sine": "0.5 Hz from 2.5 V, falling to a twentieth in 12 s, 6000 samples",
        "ramp": "up to 2.5 V in 3 s and back, 6000 samples",
        "complex": "10, 20, 30, 40 and 50 Hz together, 0.5 V each, 6000 samples",
    }

    ranges: ClassVar[Mapping[str, Range]] = MappingProxyType(
        {
            "amplitude": Range(2.2, 2.8, "V; the drive: [PEA] prints none"),
            "gain": Range(0.94, 1.15, "um/V; makers promise the stroke to 10 %"),
            "hysteresis": Range(0.35, 0.55, "share; soft ceramics, by make and poling"),
            "half_width": Range(0.7, 1.0, "V; as the share"),
            "saturation": Range(10.0, 25.0, "um; the loss of stroke within a factor of 2"),
            "asymmetry": Range(0.002, 0.010, "1/um; preload and poling"),
            "creep": Range(0.010, 0.020, "share a decade; makers' notes: 1 to 2 %"),
            "bandwidth": Range(700.0, 1300.0, "Hz; the capacitance of the stack, and the amplifier's load"),
            "natural_frequency": Range(72.0, 88.0, "Hz; the mass on the stage, within a fifth"),
            "damping_ratio": Range(0.42, 0.58, "the damper's oil, by temperature"),
            "noise": Range(0.002, 0.004, "um; strain gauges and their amplifiers"),
        }
    )

    amplitude: float = AMPLITUDE  # V, of every experiment
    gain: float = 1.046  # um/V, [PEA] Table 2, d: response of the fully driven ceramic
    hysteresis: float = 0.45  # share of the gain that has memory; ours, so that alpha comes near [PEA] Table 2
    half_width: float = 0.85  # V, mean of the play operators; ours, so that beta + gamma comes near it
    saturation: float = 15.0  # um; ours: the half stroke, a sixth of it, loses one per cent
    asymmetry: float = 0.006  # 1/um; ours: the upper half stroke is 3 % longer than the lower one
    creep: float = 0.015  # share of the displacement a decade of time; [J] and makers' notes: 1 to 2 %
    bandwidth: float = 1000.0  # Hz, amplifier with its load; ours
    natural_frequency: float = 80.5  # Hz, [PEA] Table 3: sqrt(k/m) / (2 pi)
    damping_ratio: float = 0.504  # [PEA] Table 3: (c/m) / (2 sqrt(k/m))
    resolution: float = 0.003  # um, [PEA] section 4.1
    noise: float = 0.003  # um, standard deviation; ours: as large as the resolution
    voltage_limit: float = 5.0  # V to either side; ours: twice the amplitude of the experiments
    step: float = 1e-4  # s, longest internal step; ours: halving it changes the 50 Hz displacement below 1 nm

    def __post_init__(self) -> None:
        positive = {"amplitude", "gain", "half_width", "damping_ratio", "voltage_limit", "step"}
        found = []
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name in positive and not 0.0 < value < np.inf:
                found.append(f"{field.name} must be above 0, not {value}.")
            elif field.name not in positive and not 0.0 <= value < np.inf:
                found.append(f"{field.name} must not be negative, not {value}.")
        if self.hysteresis > 1.0:
            found.append(f"hysteresis is a share, at most 1, not {self.hysteresis}.")
        if found:
            raise ValueError(" · ".join(found))

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record, named after the experiment: voltage in V, measured displacement in um.

        Raises ValueError for an unknown experiment.
        """
        return self._measured(experiment, *self.drive(experiment), rng)

    def play(self, drive: Record, rng: Generator) -> Dataset:
        """A record of the drive's name; what is beyond the voltage limit is cut."""
        return self._measured(drive.name, drive.time, np.clip(drive.input, -self.input_limit, self.input_limit), rng)

    def _measured(self, name: str, time: Array, voltage: Array, rng: Generator) -> Dataset:
        displacement = self.sensed(self.simulate(time, voltage), rng)
        return Dataset((Record(time, voltage, displacement, name, dict(self.units)),), hidden=self.hidden)

    def drive(self, experiment: str) -> tuple[Array, Array]:
        """Time in s and voltage in V of an experiment. Raises ValueError for an unknown one."""
        if experiment not in _DRIVES:
            raise ValueError(f'no experiment "{experiment}". Known: {", ".join(self.experiments)}')
        time, voltage = _DRIVES[experiment]()
        return time, voltage * (self.amplitude / AMPLITUDE)

    def simulate(self, time: Array, voltage: Array) -> Array:
        """The true displacement in um from rest; time : (samples,) s, voltage : (samples,) V, linear between
        its samples, cut at the voltage limit."""
        from hysteresis_plugins.rigs._pea_kernel import rest, simulate

        voltage = np.clip(np.asarray(voltage, dtype=float), -self.voltage_limit, self.voltage_limit)
        return simulate(rest(self.physics), np.asarray(time, dtype=float), voltage, self.physics)

    def sensed(self, displacement: Array, rng: Generator) -> Array:
        """What the sensor reads: (samples,) um -> same shape."""
        reading = displacement + self.noise * rng.standard_normal(displacement.shape)
        return self.resolution * np.round(reading / self.resolution) if self.resolution > 0.0 else reading

    def plant(self, rate: float) -> Plant:
        """The rig as a sampled plant for closed loops; rate : samples a second."""
        return Plant(self, self.physics, 1.0 / rate)

    @property
    def input_limit(self) -> float:
        return self.voltage_limit

    @property
    def noise_floor(self) -> float:
        """RMS of the noise and of rounding to the resolution, um."""
        return float(np.hypot(self.noise, self.resolution / np.sqrt(12.0)))

    @property
    def hidden(self) -> dict[str, Any]:
        """The effects beyond a static hysteresis that are switched on, and the noise."""
        effects: dict[str, Any] = {}
        if self.bandwidth > 0.0:
            effects["input-lag"] = {"time_constant": 1.0 / (2.0 * np.pi * self.bandwidth)}
        if self.saturation > 0.0:
            effects["saturation"] = {"level": self.saturation}
        if self.asymmetry > 0.0:
            effects["asymmetry"] = {"coefficient": self.asymmetry}
        if self.creep > 0.0:
            effects["creep"] = {"share_per_decade": self.creep}
        if self.natural_frequency > 0.0:
            effects["resonance"] = {"period": 1.0 / self.natural_frequency, "damping": self.damping_ratio}
        if self.noise > 0.0 or self.resolution > 0.0:
            effects["noise"] = {"output": self.noise, "resolution": self.resolution}
        return effects

    @property
    def physics(self) -> Physics:
        """The constants as the kernel takes them."""
        from hysteresis_plugins.rigs._pea_kernel import Physics

        omega = 2.0 * np.pi * self.natural_frequency if self.natural_frequency > 0.0 else np.inf
        quantiles = (np.arange(PLAYS) + 0.5) / PLAYS
        return Physics(
            amplifier_lag=1.0 / (2.0 * np.pi * self.bandwidth) if self.bandwidth > 0.0 else 0.0,
            instantaneous=self.gain * (1.0 - self.hysteresis),
            weight=self.gain * self.hysteresis / PLAYS,
            radii=-self.half_width * np.log1p(-quantiles),  # equal weights at the quantiles of an exponential
            saturation=self.saturation if self.saturation > 0.0 else np.inf,
            asymmetry=self.asymmetry,
            creep=self.creep,
            creep_times=10.0 ** np.arange(-1.0, 4.0),
            damping=2.0 * self.damping_ratio * omega,
            stiffness=omega**2,
            step=self.step,
        )


@dataclass(frozen=True, eq=False)
class Plant:
    """The rig, one sample at a time: a state goes in, a new state comes out, nothing is kept between.

        state = plant.rest()
        for target in reference:
            measured = plant.read(state, rng)
            voltage = controller(target, measured)
            state = plant.step(state, voltage)

    interval : s, between samples
    """

    rig: PeaRig
    physics: Physics
    interval: float

    def rest(self) -> Array:
        """The state of the depolarised ceramic at 0 V, at rest."""
        from hysteresis_plugins.rigs._pea_kernel import rest

        return rest(self.physics)

    def step(self, state: Array, voltage: float) -> Array:
        """The state one interval later; the voltage is held, and cut at the rig's limit, as a converter does."""
        return self.ramp(state, voltage, voltage)

    def ramp(self, state: Array, first: float, last: float) -> Array:
        """The state one interval later; the voltage goes linearly from first to last, cut at the limit."""
        from hysteresis_plugins.rigs._pea_kernel import advance

        limit = self.rig.voltage_limit
        first, last = (float(min(max(voltage, -limit), limit)) for voltage in (first, last))
        return advance(state, first, last, self.interval, self.physics)

    def displacement(self, state: Array) -> float:
        """The true displacement, um."""
        from hysteresis_plugins.rigs._pea_kernel import CREPT, DEVIATION

        return float(state[CREPT] + state[DEVIATION])

    def read(self, state: Array, rng: Generator) -> float:
        """What the sensor reads, um."""
        return float(self.rig.sensed(np.array(self.displacement(state)), rng))


def _grid(duration: float, samples: int = SAMPLES) -> Array:
    return np.arange(samples) * (duration / samples)


def _sine(frequency: float, duration: float) -> tuple[Array, Array]:
    time = _grid(duration)
    return time, AMPLITUDE * np.sin(2.0 * np.pi * frequency * time)


def _sweep(lowest: float, highest: float, duration: float, samples: int) -> tuple[Array, Array]:
    """Frequency rises linearly in time."""
    time = _grid(duration, samples)
    turns = lowest * time + (highest - lowest) * time**2 / (2.0 * duration)
    return time, AMPLITUDE * np.sin(2.0 * np.pi * turns)


def _damped(frequency: float, duration: float) -> tuple[Array, Array]:
    """Amplitude falls exponentially to a twentieth."""
    time, voltage = _sine(frequency, duration)
    return time, voltage * 0.05 ** (time / duration)


def _ramp(duration: float) -> tuple[Array, Array]:
    time = _grid(duration)
    return time, AMPLITUDE * (1.0 - np.abs(2.0 * time / duration - 1.0))


def _complex(duration: float) -> tuple[Array, Array]:
    time = _grid(duration)
    parts = [np.sin(2.0 * np.pi * frequency * time) for frequency in (10.0, 20.0, 30.0, 40.0, 50.0)]
    return time, AMPLITUDE / len(parts) * np.sum(parts, axis=0)


_DRIVES: dict[str, Callable[[], tuple[Array, Array]]] = {
    "static-sine": lambda: _sine(0.5, 6.0),
    "sweep": lambda: _sweep(0.1, 50.0, 10.0, 20_000),
    "sine-10-hz": lambda: _sine(10.0, 1.2),
    "sine-20-hz": lambda: _sine(20.0, 1.2),
    "sine-30-hz": lambda: _sine(30.0, 1.2),
    "sine-40-hz": lambda: _sine(40.0, 1.2),
    "sine-50-hz": lambda: _sine(50.0, 1.2),
    "damped-sine": lambda: _damped(0.5, 12.0),
    "ramp": lambda: _ramp(6.0),
    "complex": lambda: _complex(1.2),
}
