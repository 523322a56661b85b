"""Effects that do not say what they must."""

from dataclasses import dataclass

from hysteresis_bench.contracts import Effect


@dataclass(frozen=True)
class Silent(Effect):
    """Declares neither where it acts nor its family."""

    parameters = ()

    def apply(self, inner, signal, p):
        return inner(signal)


@dataclass(frozen=True)
class Misspelt(Silent):
    """Acts nowhere that is known."""

    acts = "outptu"
    family = "law"
