"""Find what a model lacks: data with a hidden effect, the verdict, the error before and after, a better model."""

from pathlib import Path

from hysteresis_bench import diagnose, load, measure
from hysteresis_bench.data.data_files import write_csv

EXPERIMENTS = ("slow", "fast", "nested", "mixed")

if __name__ == "__main__":
    # A rig with settings: a Bouc-Wen actuator behind a lag that the model does not know of.
    for experiment in EXPERIMENTS:
        data = measure("hidden-effects", experiment, settings={"effects": ["input-lag"]}, seed=1)
        write_csv(Path(f"{experiment}.csv"), data)

    # Records of several speeds and amplitudes; what is held out is opened once, at the end.
    data = load(*(f"{experiment}.csv" for experiment in EXPERIMENTS), held_out=["mixed"])
    found = diagnose(data, "bouc-wen")

    print(found.verdict, "·", found.headline)
    for candidate in found.candidates:
        if candidate.applicable:
            print(f"{candidate.effect:24} {'adopted' if candidate.adopted else '':8} RMSE {candidate.rmse:.4g}")
    for tie in found.ties:
        print(f"these data cannot tell {tie.effect} from {tie.rival}")
    for name, estimate in found.model.parameters.items():
        error = estimate.standard_error
        spread = "" if error is None else f" ± {error:.2g}"  # None: the data cannot tell
        print(f"{name:28} {estimate.value:.4g}{spread} {estimate.unit}")
    print(f"held out: {found.before.held_out.rmse:.3g} before, {found.after.held_out.rmse:.3g} after")
