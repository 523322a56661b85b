"""Why two effects can look the same: the physics of a tie, in words."""

from __future__ import annotations

from dataclasses import dataclass

REASONS = {
    frozenset({"input-lag", "transport-delay"}): (
        "at one frequency, after the transient, a lag before a rate-independent hysteresis and a delay both only "
        "shift the loop in time; they differ in how the shift depends on the frequency"
    ),
    frozenset({"input-lag", "output-lag"}): (
        "a small lag before the hysteresis and one after it differ only at second order in frequency times lag, "
        "where the loop is not a straight line"
    ),
    frozenset({"output-lag", "transport-delay"}): (
        "a lag that is short against the fastest movement is a delay to first order; it differs in the damping of "
        "what is fast"
    ),
    frozenset({"output-lag", "creep"}): "creep with one relaxation and nearly the whole response late is a lag",
    frozenset({"output-lag", "resonance"}): "an overdamped resonance is a lag",
    frozenset({"transport-delay", "resonance"}): "far below its natural frequency a damped resonance only delays",
    frozenset({"input-lag", "resonance"}): "an overdamped resonance is a lag, here on the other side of the hysteresis",
    frozenset({"creep", "drift"}): "creep that is slow against the record is a straight line in time",
    frozenset({"creep", "resonance"}): "both let a part of the response arrive late",
    frozenset({"creep", "input-lag"}): "both let a part of the response arrive late",
    frozenset({"fatigue", "drift"}): "over one cycle count and amplitude, a loop that shrinks also moves its ends",
    frozenset({"fatigue", "temperature-sensitivity"}): (
        "the temperature changed along with the path travelled, so that either may scale the response"
    ),
    frozenset({"drift", "temperature-sensitivity"}): (
        "the temperature changed steadily with time, so that either may move the zero"
    ),
    frozenset({"eddy-current", "input-lag"}): (
        "where the slope of the loop changes little, eddy currents are an input lag of the coefficient times the slope"
    ),
    frozenset({"eddy-current", "output-lag"}): (
        "where the slope of the loop changes little, eddy currents are a lag, and a small lag before the hysteresis "
        "and one after it differ only at second order"
    ),
    frozenset({"eddy-current", "transport-delay"}): (
        "where the slope of the loop changes little, eddy currents are a lag, which at one frequency is a delay"
    ),
    frozenset({"creep", "eddy-current"}): "both let a part of the response arrive late",
    frozenset(
        {"creep", "transport-delay"}
    ): "both let the response arrive late; they differ in how it depends on speed",
    frozenset({"asymmetry", "saturation"}): (
        "off the middle of the loop, a bend of the input and a bend of the output are the same to first order"
    ),
    frozenset({"drift", "periodic-disturbance"}): "less than a period of a slow disturbance is a drift",
    frozenset({"input-lag", "periodic-disturbance"}): (
        "with a periodic input, a disturbance of its frequency shifts the loop as a lag does"
    ),
    frozenset({"backlash", "rayleigh-hysteresis"}): "both make the loop wider with the amplitude",
    frozenset({"backlash", "input-lag"}): "at one amplitude and frequency both shift the loop after a reversal",
}
GENERIC = "on these records both change the output in the same way, within the noise"


@dataclass(frozen=True)
class Tie:
    """An adopted effect, one that would do as well in its place, and why.

    apart : RMS difference of the two fitted outputs, unit of the output
    """

    effect: str
    rival: str
    reason: str
    apart: float


def tie(effect: str, rival: str, apart: float) -> Tie:
    """With the physical reason where one is known."""
    return Tie(effect, rival, REASONS.get(frozenset({effect, rival}), GENERIC), apart)
