"""The contract tests of plugins, for their authors: a pytest plugin and the classes that it tests.

    from hysteresis_bench.testing import OptimizerContract

    class TestMine(OptimizerContract):
        plugin = "mine"

`hysteresis-bench check-plugin mine` runs the same tests without pytest.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hysteresis_bench.testing.contracts.effects import EffectContract as EffectContract
    from hysteresis_bench.testing.contracts.models import ModelContract as ModelContract
    from hysteresis_bench.testing.contracts.optimizers import OptimizerContract as OptimizerContract
    from hysteresis_bench.testing.contracts.rigs import RigContract as RigContract
else:
    _MODULES = {
        "EffectContract": "effects",
        "ModelContract": "models",
        "OptimizerContract": "optimizers",
        "RigContract": "rigs",
    }

    def __getattr__(name: str) -> Any:
        """The contracts, imported when they are first asked for: pytest loads this package in every run."""
        if name in _MODULES:
            return getattr(import_module(f"{__name__}.contracts.{_MODULES[name]}"), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
