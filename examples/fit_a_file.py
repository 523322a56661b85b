"""Fit a hysteresis model to a data file, look at what came out, and predict records that were not fitted."""

from pathlib import Path

from hysteresis_bench import FitOptions, fit, load, measure, predict
from hysteresis_bench.data.data_files import write_csv
from hysteresis_bench.fit.model_file import write_model

if __name__ == "__main__":
    # Your own file needs a header with time, input and output; here a virtual rig plays the actuator.
    for experiment in ("slow", "nested", "mixed"):
        write_csv(Path(f"{experiment}.csv"), measure("hidden-effects", experiment, seed=1))

    data = load("slow.csv", "nested.csv", "mixed.csv", held_out=["mixed"])
    result = fit(data, "bouc-wen", options=FitOptions(seed=1))

    print(result.parameters.to_string(index=False))  # name, value, standard_error, unit, at_bound
    print(result.records.to_string(index=False))  # the error of every record; mixed was not fitted
    print(result.agreement, *result.warnings, sep="\n")

    write_model(Path("model.json"), result.model)
    measured = load("mixed.csv").records[0]
    predicted = predict("model.json", "mixed.csv").records[0]
    worst = abs(predicted.output - measured.output).max()
    print(f"The largest error of {predicted.output.size} predicted samples is {worst:.3g}.")
