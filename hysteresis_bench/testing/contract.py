"""What all contracts share: a promise is a test method, and a broken one is told in a sentence."""

from __future__ import annotations

from typing import Any, ClassVar


class Broken(AssertionError):
    """A plugin breaks its contract. The message says where and what, and what would be right."""


def expect(kept: object, otherwise: str) -> None:
    """Raises Broken with the sentence unless the promise is kept."""
    if not kept:
        raise Broken(otherwise)


class Contract:
    """The promises of a plugin, a method each; the first paragraph of its docstring is the promise.

    plugin : the registered name, or several; a subclass in a test file says it
    kind : of the plugin, as registry.Kind
    """

    plugin: ClassVar[str | tuple[str, ...]] = ()
    kind: ClassVar[Any]


def promises(contract: type[Contract]) -> dict[str, str]:
    """What a contract asks, in the order in which it is written: the method's name and its promise."""
    methods = {name: method for base in reversed(contract.__mro__) for name, method in vars(base).items()}
    return {
        name: " ".join((method.__doc__ or name).split("\n\n")[0].split())
        for name, method in methods.items()
        if name.startswith("test_")
    }
