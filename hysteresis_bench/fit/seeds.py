"""Random numbers from a key: the same whatever the order and the number of workers."""

from __future__ import annotations

import hashlib

import numpy as np
from numpy.random import Generator, SeedSequence, default_rng

from hysteresis_bench.arrays import Array
from hysteresis_bench.contracts import Start


def seed_of(*key: object) -> str:
    """SHA-256 of the key's parts joined by "|", as hexadecimal digits."""
    return hashlib.sha256("|".join(str(part) for part in key).encode()).hexdigest()


def generator(*key: object) -> Generator:
    """A random generator that depends on the key alone."""
    return default_rng(SeedSequence(int(seed_of(*key), 16)))


def shared_start(dimension: int, *key: object) -> Start:
    """First points for all optimizers of a trial; a larger swarm begins with the smaller one."""

    def start(particles: int) -> Array:
        return np.ascontiguousarray(generator(*key).random((particles, dimension)).T)

    return start
