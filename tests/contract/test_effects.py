"""What every registered effect promises."""

from hysteresis_bench import registry
from hysteresis_bench.testing import EffectContract


class TestEffects(EffectContract):
    plugin = tuple(
        name for name in registry.names("effects") if registry.load("effects", name).distribution == "hysteresis-bench"
    )
