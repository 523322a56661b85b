"""What every registered rig promises."""

from hysteresis_bench import registry
from hysteresis_bench.testing import RigContract


class TestRigs(RigContract):
    plugin = tuple(
        name for name in registry.names("rigs") if registry.load("rigs", name).distribution == "hysteresis-bench"
    )
