"""What pytest learns on its own where this package is installed: a contract is tested for every plugin that it names.

It imports nothing slow, for it is loaded in every run of pytest.
"""

from __future__ import annotations

from typing import Any

from hysteresis_bench.testing.contract import Contract


def pytest_generate_tests(metafunc: Any) -> None:
    """The argument `plugin` of a contract's promises: each name of the class attribute."""
    owner = metafunc.cls
    if isinstance(owner, type) and issubclass(owner, Contract) and "plugin" in metafunc.fixturenames:
        metafunc.parametrize("plugin", [owner.plugin] if isinstance(owner.plugin, str) else owner.plugin)
