"""What every registered model promises."""

from hysteresis_bench import registry
from hysteresis_bench.testing import ModelContract


class TestModels(ModelContract):
    plugin = tuple(
        name for name in registry.names("models") if registry.load("models", name).distribution == "hysteresis-bench"
    )
