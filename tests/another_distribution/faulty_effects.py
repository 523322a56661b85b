"""Effects that do not say what they must."""

from hysteresis_bench.contracts import Effect


class Silent(Effect):
    """Declares neither where it acts nor its family."""

    parameters = ()

    def apply(self, inner, signal, p):
        return inner(signal)


class Misspelt(Silent):
    """Acts nowhere that is known."""

    acts = "outptu"
    family = "law"
