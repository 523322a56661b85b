"""Shape memory alloy rig: two antagonistic wires turn a joint; temperature in, rotation angle out."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.random import Generator

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import DrivenRig, Range
from hysteresis_bench.signals import Dataset, Record
from hysteresis_plugins.rigs._sma_mechanics import Physics, mechanics

SUPPLY = 5.0  # V, [SMA] section 2
RATE = 10.0  # samples a second; ours, so that two cycles of 60 s are 1200 samples


class Truth(NamedTuple):
    """What happens in the rig, free of noise; (samples,) each."""

    jacket: Array  # degC
    reading: Array  # degC, the sensor's
    wire: Array  # degC, the temperature that acts on the phases
    martensite: Array  # fraction of the driven wire
    stress: Array  # Pa, of the driven wire
    angle: Array  # deg


@dataclass(frozen=True)
class SmaRig(DrivenRig):
    """Two antagonistic shape memory alloy wires, one of them heated, turn a joint against a torsion spring.

    Built after the bench of [SMA] (section 2, Figures 1 to 3): 0.25 mm NiTi wires, couplers, torsion spring,
    potentiometer, 5 V at 50 % duty, 0 to 60 degC. The paper gives no other constant and no data.

    Heat. Each wire runs loosely in a thin tube that carries a heating film (the jacket). The voltage heats
    the jacket, which loses heat to the air by convection; the wire inside follows across the air gap with
    its own time constant `wire_lag` and takes up and gives back the latent heat. The thermocouple sits on
    the jacket. So the temperature that is read LEADS the one that acts, and a first-order lag of the reading
    (the effect input-lag) is what a model of angle over reading lacks. The thermocouple's own `sensor_lag`
    works the other way and is small. With wire_lag = 0 jacket and wire are one body, as in a wire that
    is heated by its own current: then only sensor_lag separates the reading from the truth, and the
    reading lags. With a slow sensor, wire_lag = 0 and sensor_lag = 3.4, Jiles-Atherton takes values near the
    published ones (alpha 1e-14, a 9, M_s 2.3e7, c above 1), which it does not on the rig as it stands.

    Phases. The cosine law of [LR] with transformation temperatures that rise with the stress. It has memory
    through one number a direction: at every reversal the curve of the new direction is scaled to pass
    through the present fraction of martensite, so that the fraction is continuous (ours: [LR] let it
    start only at the edge of the band, which needs bands that do not overlap). A minor loop stays inside
    the major one. It does not return exactly to its reversal point: there is no return-point memory.
    Passing a whole band wipes the memory out.

    Mechanics. Static equilibrium of driven wire, antagonist, their elastic anchors and the torsion spring.
    The antagonist stays at ambient temperature, elastic martensite. All martensite is stress-oriented: the
    prestress sees to that. The joint is cooled below `martensite_finish` before a record and starts at rest
    at ambient temperature and angle 0. The alloy's transformation temperatures are ours, placed such that
    the loop fills 0 to 60 degC and begins to rise near 0, as the published parameters ask (a = 8 to 10
    degC). The cold end keeps a part of the angle, because at 0 degC the alloy is still above its M_f.

    Settings are SI units but for temperatures in degC and angles in degrees. Raises ValueError that tells all
    settings that make no rig. Effects are switched off by wire_lag, sensor_lag, latent_heat, temperature_noise,
    angle_noise or angle_resolution = 0.

    Of these constants [SMA] gives wire, supply, duty and temperatures only. The lags and the heat loss follow from
    dimensions; the alloy's temperatures were placed by us. `ranges` says how far each differs from one joint to the
    next: between the ends of any two, cooling still transforms below heating and the cold joint is at rest.

    [SMA] Jiles-Atherton based hysteresis identification of shape memory alloy-actuating compliant mechanism
          via modified particle swarm optimization algorithm
    [LR]  Liang and Rogers, J. Intell. Mater. Syst. Struct. 1 (1990) 207-234
    [B]   Brinson, J. Intell. Mater. Syst. Struct. 4 (1993) 229-242, table of material constants
    [D]   Dynalloy, Flexinol technical data
    """

    units: ClassVar[Mapping[str, str]] = MappingProxyType({"time": "s", "input": "degC", "output": "deg"})
    experiments: ClassVar[dict[str, str]] = {
        "pwm-50s": "2 cycles of 50 s, 5 V at 50 % duty, 10 samples a second, from rest at 0 degC",
        "pwm-60s": "2 cycles of 60 s, 5 V at 50 % duty, 10 samples a second, from rest at 0 degC",
        "pwm-60s-long": "6 cycles of 60 s, 5 V at 50 % duty",
        "minor-loops": "a major loop, then reversals that close in on its middle, and the way back to the top",
        "slow": "2 nearly quasi-static loops of half an hour: heating power rises and falls linearly",
        "steps": "heating power in steps of a quarter, up and down, each held for 40 s",
    }

    ranges: ClassVar[Mapping[str, Range]] = MappingProxyType(
        {
            "supply": Range(4.8, 5.2, "V; the drive: a supply within 4 %"),
            "resistance": Range(9.2, 10.2, "ohm; heating films are wound to 5 %"),
            "convection": Range(0.17, 0.24, "W/(m K); free convection depends on draught and on how the tube lies"),
            "wire_lag": Range(2.7, 4.1, "s; the wire lies in the middle of its tube, or nearer to its side"),
            "sensor_lag": Range(0.1, 0.4, "s; size and glue of the bead"),
            "martensite_finish": Range(-20.0, -16.0, "degC; a tenth of a per cent of nickel shifts it by 10 K"),
            "martensite_start": Range(15.0, 18.0, "degC; alloy and training"),
            "austenite_start": Range(
                -2.0, 1.0, "degC; alloy and training; any lower and the cold joint is not at rest"
            ),
            "austenite_finish": Range(28.5, 33.0, "degC; alloy and training"),
            "transformation_strain": Range(0.035, 0.043, "what a trained wire strains after many cycles"),
            "prestress": Range(32e6, 40e6, "Pa; set by hand"),
            "anchor_stiffness": Range(1600.0, 2400.0, "N/m; compliant couplers within a fifth"),
            "torsion_stiffness": Range(4e-3, 6e-3, "N m/rad; springs of one make, within a fifth"),
            "angle_noise": Range(0.03, 0.07, "deg; potentiometers and their wiring"),
        }
    )

    supply: float = SUPPLY  # V, [SMA] section 2
    ambient: float = 0.0  # degC; ours: the cold end of the range in [SMA]

    resistance: float = 9.7  # ohm, heating film; ours: 5 V settle near 60 degC
    jacket_heat_capacity: float = 1.05  # J/(m K); ours: polyimide tube 2.0/2.2 mm (1.02) and a thin metal film
    convection: float = 0.207  # W/(m K); ours: 30 W/(m^2 K), free convection and radiation, on 2.2 mm
    wire_lag: float = 3.4  # s; ours: density c d^2 ln(2.0/0.25) / (8 * 0.026 W/(m K)), air in a 2.0 mm bore
    sensor_lag: float = 0.2  # s; ours: a fine bead bonded to the jacket

    wire_diameter: float = 0.25e-3  # m, [SMA] section 2
    wire_length: float = 0.20  # m; ours
    density: float = 6450.0  # kg/m^3, [D]
    specific_heat: float = 837.0  # J/(kg K), [D]: 0.2 cal/(g K)
    latent_heat: float = 24.2e3  # J/kg, [D]: 5.78 cal/g

    martensite_finish: float = -18.0  # degC without stress; ours
    martensite_start: float = 17.0  # degC without stress; ours
    austenite_start: float = -2.0  # degC without stress; ours
    austenite_finish: float = 30.0  # degC without stress; ours
    martensite_slope: float = 8.0e6  # Pa/K, [B] C_M
    austenite_slope: float = 13.8e6  # Pa/K, [B] C_A
    martensite_modulus: float = 26.3e9  # Pa, [B] D_m
    austenite_modulus: float = 67.0e9  # Pa, [B] D_a
    transformation_strain: float = 0.04  # ours: the usual working stroke of a trained wire, 3 to 5 %

    prestress: float = 35.0e6  # Pa, both wires, cold; ours
    coupler_radius: float = 10.0e-3  # m; ours
    anchor_stiffness: float = 2000.0  # N/m, each wire; ours: the compliant couplers
    torsion_stiffness: float = 5.0e-3  # N m/rad; ours

    temperature_noise: float = 0.1  # degC, standard deviation; ours
    angle_noise: float = 0.05  # deg, standard deviation; ours
    angle_resolution: float = 0.01  # deg; ours: 340 deg potentiometer on a 16 bit converter, rounded up

    step: float = 0.05  # s, longest integration step; ours: halving it changes the angle by less than 1e-3 deg

    def __post_init__(self) -> None:
        faults = self._faults()
        if faults:
            raise ValueError(" · ".join(faults))

    def measure(self, experiment: str, rng: Generator) -> Dataset:
        """One record, named after the experiment: reading in degC, angle in deg, voltage as a column.

        Raises ValueError for an unknown experiment.
        """
        if experiment not in self.experiments:
            raise ValueError(f'no experiment "{experiment}". Known: {", ".join(self.experiments)}')
        time, voltage = _DRIVES[experiment]()
        return self._measured(experiment, time, voltage * (self.supply / SUPPLY), rng)

    def play(self, drive: Record, rng: Generator) -> Dataset:
        """A record of the drive's name, by a thermostat that knows the rig: it heats up to the supply, and cooling is
        left to the air, so that it follows slow temperatures only."""
        from hysteresis_plugins.rigs._sma_thermostat import voltage_for

        step = max(1.0 / RATE, float(drive.time[1] - drive.time[0]))
        time = np.arange(round(float(drive.time[-1]) / step) + 1) * step
        wanted = np.interp(time, drive.time, drive.input)

        def read(voltage: Array) -> Array:
            return self.simulate(time, voltage).reading

        return self._measured(drive.name, time, voltage_for(time, wanted, read, self.supply, self.physics), rng)

    def _measured(self, name: str, time: Array, voltage: Array, rng: Generator) -> Dataset:
        truth = self.simulate(time, voltage)
        reading = truth.reading + self.temperature_noise * rng.standard_normal(time.size)
        angle = truth.angle + self.angle_noise * rng.standard_normal(time.size)
        if self.angle_resolution > 0.0:
            angle = self.angle_resolution * np.round(angle / self.angle_resolution)
        record = Record(time, reading, angle, name, {**self.units, "voltage": "V"}, {"voltage": voltage})
        return Dataset((record,), hidden=self.hidden)

    def simulate(self, time: Array, voltage: Array) -> Truth:
        """The noise-free truth at these times from rest; time : (samples,) s, voltage : (samples,) V, each
        held until the next sample."""
        from hysteresis_plugins.rigs._sma_kernel import simulate

        jacket, reading, wire, martensite, stress, rotation = simulate(
            np.asarray(time, dtype=float), np.asarray(voltage, dtype=float), self.step, self.physics
        )
        return Truth(jacket, reading, wire, martensite, stress, np.degrees(rotation))

    @property
    def hidden(self) -> dict[str, Any]:
        """The effects between reading and angle that are switched on, and the noise."""
        effects: dict[str, Any] = {}
        if self.wire_lag > 0.0:
            effects["input-lag"] = {"time_constant": self.wire_lag}
        if self.sensor_lag > 0.0:
            effects["sensor-lag"] = {"time_constant": self.sensor_lag}
        if self.latent_heat > 0.0:
            effects["latent-heat"] = {"temperature_rise": self.latent_heat / self.specific_heat}
        if self.temperature_noise > 0.0 or self.angle_noise > 0.0:
            effects["noise"] = {"input": self.temperature_noise, "output": self.angle_noise}
        return effects

    @property
    def physics(self) -> Physics:
        """The constants as the kernel takes them."""
        section = np.pi / 4.0 * self.wire_diameter**2
        wire_heat_capacity = self.density * section * self.specific_heat
        body = wire_heat_capacity + (0.0 if self.wire_lag > 0.0 else self.jacket_heat_capacity)
        derived = {
            "resistance": self.resistance * self.wire_length,
            "wire_heat_capacity": wire_heat_capacity,
            "latent_rise": self.density * section * self.latent_heat / body,
            "length": self.wire_length,
            "section": section,
            "radius": self.coupler_radius,
        }
        settings = {field.name: getattr(self, field.name) for field in fields(self)}
        return Physics(**{name: float((settings | derived)[name]) for name in Physics._fields})

    def _faults(self) -> list[str]:
        """What makes no rig, a sentence each."""
        may_vanish = {"latent_heat", "wire_lag", "sensor_lag", "prestress", "torsion_stiffness"}
        may_vanish |= {"temperature_noise", "angle_noise", "angle_resolution", "transformation_strain"}
        temperatures = ("martensite_finish", "martensite_start", "austenite_start", "austenite_finish")
        found = []
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name in may_vanish and not value >= 0.0:
                found.append(f"{field.name} must not be negative, not {value}.")
            elif field.name not in {"ambient", *temperatures, *may_vanish} and not value > 0.0:
                found.append(f"{field.name} must be above 0, not {value}.")
        if not self.martensite_finish < self.martensite_start:
            found.append("martensite_finish must lie below martensite_start.")
        if not self.austenite_start < self.austenite_finish:
            found.append("austenite_start must lie below austenite_finish.")
        return found or self._disorder()

    def _disorder(self) -> list[str]:
        """Whether cooling transforms below heating, and the rest state is at rest, at every stress of the rig."""
        found = []
        for martensite in (0.0, 1.0):
            stress = mechanics(martensite, self.physics)[0]
            shift = stress * (1.0 / self.martensite_slope - 1.0 / self.austenite_slope)
            if self.martensite_finish + shift >= self.austenite_start:
                found.append(f"martensite_finish lies above austenite_start at {stress / 1e6:.0f} MPa.")
            if self.martensite_start + shift >= self.austenite_finish:
                found.append(f"martensite_start lies above austenite_finish at {stress / 1e6:.0f} MPa.")
        if self.ambient > self.austenite_start + self.prestress / self.austenite_slope:
            found.append("ambient lies above austenite_start at the prestress: the cold joint is not at rest.")
        return found


def _pulses(durations: Sequence[float]) -> tuple[Array, Array]:
    """Supply on, off, on, ... for these durations in s -> time, voltage."""
    counts = np.rint(np.asarray(durations) * RATE).astype(int)
    levels = np.where(np.arange(counts.size) % 2 == 0, SUPPLY, 0.0)
    return np.arange(counts.sum()) / RATE, np.repeat(levels, counts)


def _ramps(cycles: int, period: float, interval: float) -> tuple[Array, Array]:
    """Heating power in triangles, sampled at the interval, both in s -> time, voltage."""
    time = np.arange(round(cycles * period / interval)) * interval
    phase = time / period % 1.0
    return time, SUPPLY * np.sqrt(1.0 - np.abs(2.0 * phase - 1.0))


def _staircase(hold: float) -> tuple[Array, Array]:
    """Heating power in quarters, up and down, each held so long in s -> time, voltage."""
    power = np.array([0.25, 0.5, 0.75, 1.0, 0.75, 0.5, 0.25, 0.0])
    voltage = np.repeat(SUPPLY * np.sqrt(power), round(hold * RATE))
    return np.arange(voltage.size) / RATE, voltage


_DRIVES: dict[str, Callable[[], tuple[Array, Array]]] = {
    "pwm-50s": lambda: _pulses([25.0] * 4),
    "pwm-60s": lambda: _pulses([30.0] * 4),
    "pwm-60s-long": lambda: _pulses([30.0] * 12),
    "minor-loops": lambda: _pulses([30, 30, 30, 20, 9, 11, 6.5, 8, 4.5, 6, 3, 4.5, 30, 30]),
    "slow": lambda: _ramps(cycles=2, period=1800.0, interval=1.0),
    "steps": lambda: _staircase(hold=40.0),
}
