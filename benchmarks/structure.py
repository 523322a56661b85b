"""Structure tests on data of every law: how often they refute what is true, and whether they see what is missing.

    python benchmarks/structure.py [LAW ...] [--seeds 2]

Every law that makes data of its own is driven by excitations of several shapes, with noise, white or autocorrelated.
False alarms: p below 0.01 for a property that the law declares. Power: p below 0.001 for one that its data miss by
more than MISSED % of their range, known from the same data without noise.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache

import numpy as np
from rich.console import Console
from rich.table import Table

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.compose import System
from hysteresis_bench.contracts import Property
from hysteresis_bench.diagnosis.evidence.view import views_of
from hysteresis_bench.diagnosis.structure.finding import LEVEL, Name
from hysteresis_bench.diagnosis.structure.structure import Structure, structure
from hysteresis_bench.signals import Record

CYCLES = 4.0
RUNS = ((1.0, 1.0), (0.6, 1.0), (1.0, 2.0))
"""Amplitude, as a share of the law's own, and frequency of the records of one case."""
LEVELS = (0.001, 0.003, 0.01)
DECAYS = (0.0, 0.9)
SAMPLES = (250, 700)
MISSED = 1.0
ALARM = 0.01

ASKS: Mapping[Name, Property] = {
    "reversal lag": "rate-independent",
    "closure": "return-point",
    "odd symmetry": "odd",
    "Masing's rule": "masing",
    "rising and falling branches": "masing",
    "return-point memory": "return-point",
    "congruency": "congruent",
    "rate independence": "rate-independent",
}


def sine(phase: Array) -> Array:
    return np.sin(2.0 * np.pi * phase)


def triangle(phase: Array) -> Array:
    return 2.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * phase))


def modulated(phase: Array) -> Array:
    return sine(phase) * (0.3 + 0.7 * phase / CYCLES)


def minor_loops(phase: Array) -> Array:
    return 0.6 * sine(phase) + 0.4 * sine(3.0 * phase)


def steps(phase: Array) -> Array:
    """A staircase, up and down, of sixteen steps a cycle."""
    return np.round(8.0 * triangle(phase)) / 8.0


DRIVES: Mapping[str, Callable[[Array], Array]] = {
    "sine": sine,
    "triangle": triangle,
    "modulated": modulated,
    "minor loops": minor_loops,
    "steps": steps,
}


def coloured(rng: np.random.Generator, samples: int, decay: float) -> Array:
    """Noise of unit variance, an autoregression of the first order, (samples,)."""
    from scipy.signal import lfilter

    white = rng.standard_normal(samples + 400)
    found: Array = lfilter([np.sqrt(1.0 - decay**2)], [1.0, -decay], white)[400:]
    return found


@cache
def clean(law: str, drive: str, samples: int) -> tuple[Record, ...]:
    """Without noise, with the law's own example of its parameters."""
    model = registry.build("models", law)
    system = System(model)
    values = np.array([[model.example.parameters[q.name]] for q in system.parameters])
    records = []
    for number, (share, frequency) in enumerate(RUNS):
        time = np.linspace(0.0, CYCLES / frequency, samples)
        u = share * model.example.amplitude * DRIVES[drive](time * frequency)
        y = system.simulate(Record(time, u, None).signal, values)[:, 0]
        records.append(Record(time, u, y, f"run {number}"))
    return tuple(records)


def noisy(records: Sequence[Record], level: float, decay: float, seed: int) -> list[Record]:
    """level : share of the largest range"""
    rng = np.random.default_rng(seed)
    span = max(float(np.ptp(record.measured)) for record in records)
    return [
        Record(r.time, r.input, r.measured + level * span * coloured(rng, r.time.size, decay), r.name) for r in records
    ]


def answers(law: str, drive: str, samples: int, seeds: int) -> Iterator[tuple[float, float, Structure]]:
    """Level and decay of the noise, and what the tests say."""
    for level in LEVELS:
        for decay in DECAYS:
            for seed in range(seeds):
                seen = noisy(clean(law, drive, samples), level, decay, seed)
                yield level, decay, structure(views_of(seen))


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("laws", nargs="*")
    parser.add_argument("--seeds", type=int, default=2)
    given = parser.parse_args(arguments)
    known = [n for n in registry.names("models") if registry.build("models", n).example is not None]
    alarms: dict[Name, list[float]] = defaultdict(list)
    worst: dict[Name, dict[str, list[bool]]] = defaultdict(lambda: defaultdict(list))
    power: dict[tuple[str, Name, float], list[bool]] = defaultdict(list)
    for law in given.laws or known:
        has = registry.build("models", law).properties
        for drive in DRIVES:
            for samples in SAMPLES:
                truth = structure(views_of(clean(law, drive, samples)))
                for level, decay, found in answers(law, drive, samples, given.seeds):
                    for name, asked in ASKS.items():
                        one = found.of(name)
                        if not one.applies:
                            continue
                        if asked in has:
                            alarms[name].append(one.p)
                            worst[name][f"{law}, {drive}, {samples}, {decay:g}"].append(one.p < ALARM)
                        elif truth.of(name).statistic > MISSED:
                            power[law, name, level].append(one.p < LEVEL)
        print(f"{law}: done", flush=True)
    tell(alarms, worst, power)


def tell(
    alarms: Mapping[Name, Sequence[float]],
    worst: Mapping[Name, Mapping[str, Sequence[bool]]],
    power: Mapping[tuple[str, Name, float], Sequence[bool]],
) -> None:
    console = Console(width=140, highlight=False)
    table = Table("test", "cases", "p < 0.01", "p < 0.001", "smallest p", "worst kind of data", title="False alarms, %")
    for name, p in alarms.items():
        kind = max(worst[name], key=lambda key: np.mean(worst[name][key]))
        shares = (100.0 * np.mean(np.array(p) < limit) for limit in (ALARM, LEVEL))
        told = f"{kind}: {100.0 * np.mean(worst[name][kind]):.0f} of {len(worst[name][kind])}"
        table.add_row(name, str(len(p)), *(f"{share:.2f}" for share in shares), f"{min(p):.1g}", told)
    console.print(table)
    title = f"Power, %: p < {LEVEL:g} where the law misses the property by more than {MISSED:g} % of the range"
    table = Table("law", "test", *(f"{100 * level:g} % noise" for level in LEVELS), "cases", title=title)
    for law, name in dict.fromkeys((law, name) for law, name, _ in power):
        found = [power[law, name, level] for level in LEVELS]
        table.add_row(law, name, *(f"{100 * np.mean(one):.0f}" for one in found), str(sum(len(one) for one in found)))
    console.print(table)


if __name__ == "__main__":
    main()
