"""Instances of a problem: the rig as it stands, and others whose constants, noise and drive are drawn.

What is drawn depends on the study's seed, the rig and the instance's number alone: problems on the same rig share it,
and so do all optimizers. The first instance is the rig as it stands.
"""

from __future__ import annotations

from hysteresis_bench import registry
from hysteresis_bench.contracts import Range, Rig
from hysteresis_bench.fit.seeds import generator
from hysteresis_bench.study.kept_files.trial_rows import FIRST
from hysteresis_bench.study.study_file import ProblemSpec


def instance_key(instance: int) -> tuple[object, ...]:
    """What an instance adds to the key of random numbers."""
    return () if instance == FIRST else ("instance", instance)


def ranges_of(spec: ProblemSpec) -> dict[str, Range]:
    """What differs between the instances of a problem: what its rig declares and the study does not set, then what the
    study gives. Empty on data."""
    if spec.rig is None:
        return {}
    rig: type[Rig] = type(registry.build("rigs", spec.rig, spec.rig_settings))
    declared = {name: found for name, found in rig.ranges.items() if name not in spec.rig_settings}
    return declared | {name: Range(*ends, "of the study file") for name, ends in spec.ranges.items()}


def drawn_constants(spec: ProblemSpec, seed: int, instance: int) -> dict[str, float]:
    """Settings of the rig, uniform in their ranges; a constant's number does not depend on which others are drawn."""
    if instance == FIRST:
        return {}
    return {
        name: float(generator(seed, spec.rig, *instance_key(instance), name).uniform(found.lower, found.upper))
        for name, found in ranges_of(spec).items()
    }
