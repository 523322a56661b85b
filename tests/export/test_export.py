"""Exported files say what `predict` says, sample by sample, and do without this package."""

import ctypes
import importlib.util
import shutil
import subprocess
import sys
import time
from dataclasses import asdict, replace

import numpy as np
import pytest
from click.testing import CliRunner

from hysteresis_bench import registry
from hysteresis_bench.arrays import Array
from hysteresis_bench.cli import main
from hysteresis_bench.compose import System
from hysteresis_bench.errors import UserError
from hysteresis_bench.export.functions import gathered
from hysteresis_bench.export.to_c import c_of
from hysteresis_bench.export.write import exported
from hysteresis_bench.fit.model_file import Estimate, FittedModel, write_model
from hysteresis_bench.fit.preparation import Preparation
from hysteresis_bench.signals import Dataset, Record

TIME = np.linspace(0.0, 2.0, 1500) + 0.0002 * np.sin(np.arange(1500))
INPUT = 3.0 * np.sin(2 * np.pi * 1.5 * TIME) * (0.3 + TIME / 2.0) + 0.4 * np.sin(2 * np.pi * 11.0 * TIME)
MASS = {"mass": 2e-4, "damping": 4e-3}
LAWS = {
    "bouc-wen": {"alpha": 0.35, "beta": 0.7, "gamma": 0.15, "d": 1.2},
    "hammerstein": {
        "alpha": 0.35, "beta": 0.7, "gamma": 0.15, "d": 1.2, "b": 5e4, "c_over_m": 60.0, "k_over_m": 4e4,
    },
    "jiles-atherton": {"alpha": 1e-4, "a": 1.1, "k": 0.9, "M_s": 1.3e3, "c": 0.2},
    "jiles-atherton-clamped": {"alpha": 1e-4, "a": 1.1, "k": 0.9, "M_s": 1.3e3, "c": 0.2},
    "jiles-atherton-pinning": {"alpha": 1e-4, "a": 1.1, "k": 0.9, "M_s": 1.3e3, "c": 0.2, "kappa": 1.5},
    "free-energy": {"M_R": 1.0, "eta": 4.0, "H_c": 1.1, "b": 1.0, "c": 0.35, "alpha": 0.6},
    "free-energy-gma": {
        "lambda_s": 1e-3, "M_s": 7.7e5, "M_R": 5e5, "eta": 5.0, "H_c": 1e4, "b": 2e4, "c": 0.35, "alpha": 2e-9,
    },
    "lugre": {
        "distance": 0.4, "stiction": 1.3, "v_s": 8.0, "slope": 0.4, "F_C": 1.5, "sigma_1": 0.0, "sigma_2": 0.0,
    },
    **{
        law: dict(registry.load("models", law).loaded.example.parameters)
        for law in (
            "bouc-wen-generalized", "chaboche", "chaboche-bowed", "dahl", "duhem", "energy-based", "ferroelectric",
            "flag-shaped", "folz-filiatrault", "maxwell-slip", "pinching", "prandtl-ishlinskii",
            "prandtl-ishlinskii-modified", "preisach", "self-centring",
        )
    },
    "oscillator": {**MASS, "alpha": 0.35, "beta": 0.7, "gamma": 0.15, "d": 1.2},
    "preisach-hats": {
        "radius": 2.0, "centre": 0.2, "grading": 1.5, "slope": 0.3,
        **{f"w{k}_{j}": 0.02 * (1 + (3 * k + 5 * j) % 7) for k in range(13) for j in range(1, 25)},
    },
}  # fmt: skip
BENDS = {f"bend{k}": 0.1 * (-1) ** k for k in (0, 1, 2, 3, 5, 6, 7)}
MODES = {
    "period1": 0.02, "damping1": 0.2, "weight1": 0.8, "lead1": 0.3,
    "period2": 0.008, "damping2": 0.1, "weight2": 0.3, "lead2": -0.2,
}  # fmt: skip
LEVELS = {
    "bottom": -2.5,
    "top": 2.0,
    "time_constant": 0.02,
    "at_lowest": 2.0,
    "at_low": 0.5,
    "at_high": 1.5,
    "at_highest": 3.0,
}
RIPPLE = {"sine": 0.1, "cosine": -0.2, "second": 0.4, "second_aside": -0.3, "period": 0.4}
WEIGHTS = {f"weight{k}": (-1) ** k * 0.1 * k for k in range(1, 8)}
EFFECTS = {
    "asymmetry": {"curvature": 0.03},
    "input-bias": {"offset": 0.2},
    "backlash": {"half_width": 0.3},
    "bias": {"offset": 0.7},
    "cogging": RIPPLE,
    "cogging-wave": {
        "period": 0.4, **{f"{name}{k}": 0.1 / k * (-1) ** k for k in range(1, 7) for name in ("sine", "cosine")},
    },
    "creep": {"share": 0.2, "time_constant": 0.1, "decades": 2.0},
    "cubic-stiffness": {"cubic": 0.02},
    "drift": {"rate": -0.3},
    "droop": {"rate": 2.0, "share": 0.8},
    "fatigue": {"rate": 0.01},
    "input-cyclic-error": RIPPLE,
    "input-dead-zone": {"share": 0.9, "half_width": 0.3, "centre": 0.1, "rounding": 0.05},
    "input-lag": {"time_constant": 0.01},
    "leakage": {"conductance": 0.5},
    "output-cyclic-error": RIPPLE,
    "output-dead-zone": {"share": 1.0, "half_width": 0.1, "centre": -0.1, "rounding": 0.0},
    "output-lag": {"time_constant": 0.02},
    "periodic-disturbance": {"cosine": 0.1, "sine": -0.2, "frequency": 7.0},
    "rayleigh-hysteresis": {"coefficient": 0.02},
    "record-drift": {},
    "record-offset": {},
    "resonance": {"period": 0.02, "damping": 0.2},
    "stop-above": {"level": 0.6, "share": 0.8, "rounding": 0.1},
    "stop-below": {"level": -0.4, "share": 1.0, "rounding": 0.0},
    "saturation": {"inverse_level": 0.25, "sharpness": 3.0},
    "second-order-input-lag": {"time_constant": 0.01, "damping": 0.9},
    "second-order-lag": {"time_constant": 0.02, "damping": 1.4},
    "slew-rate-limit": {"slowness": 0.1, "skew": 0.3},
    "transport-delay": {"delay": 0.0133},
    "disturbance-wave": {
        "duration": 1.6, "frequency": 7.0, **{f"cosine{k}": 0.1 * k for k in range(5)},
        **{f"sine{k}": 0.3 - 0.1 * k for k in range(5)},
        "cosine_of_2": 0.1, "sine_of_2": -0.2, "cosine_of_3": 0.05, "sine_of_3": 0.1,
    },
    "gain-with-path": {"longest": 40.0, **{f"gain{k}": -0.05 * k for k in range(1, 7)}},
    "gain-with-time": {"duration": 1.6, **{f"gain{k}": -0.05 * k for k in range(1, 7)}},
    "input-curve": {"lowest": -2.5, "highest": 2.0, "origin": 0.1, "corner": 0.3, **BENDS},
    "lag-curve-after": {"bend": 3.0, "falling_fast": 0.05, "falling": 0.02, "rising": 0.01, "rising_fast": 0.0},
    "lag-curve-before": {"bend": 3.0, "falling_fast": 0.01, "falling": 0.02, "rising": 0.0, "rising_fast": 0.05},
    "lag-with-level-after": LEVELS,
    "lag-with-level-before": LEVELS,
    "lags-after": {"shortest": 1e-3, "longest": 1.0, **WEIGHTS},
    "lags-before": {"shortest": 1e-3, "longest": 1.0, **WEIGHTS},
    "leakage-curve": {"largest": 3.0, **{f"current{k}": 0.5 / k for k in range(1, 8)}},
    "modes-after": MODES,
    "modes-before": MODES,
    "output-curve": {"lowest": -2.5, "highest": 2.0, **BENDS},
    "parallel-curve": {
        "lowest": -2.5, "highest": 2.0, **{f"bend{k}": 0.1 * (-1) ** k for k in range(10) if k != 5},
    },
    "play-bank": {"reach": 1.5, **{f"weight{k}": 0.05 for k in range(1, 11)}},
    "record-wave": {
        **{"duration": 1.6, "frequency": 7.0, "amplitude_of_2": 0.1, "amplitude_of_3": 0.0},
        **{f"amplitude{k}": 0.1 * k for k in range(5)},
    },
    "zero-with-time": {"duration": 1.6, **{f"zero{k}": 0.1 * k for k in range(1, 7)}},
}  # fmt: skip
SETTINGS = {"record-offset": {"default": 0.25}}
OF_LAWS = {
    "oscillator": {"substeps": 1},
    "bouc-wen": {"n": 1.0},
    "free-energy-gma": {"bias_field": 1.5e4, "turns": 9e3},
}


def fitted(law="bouc-wen", effects=(), preparation=None, settings=None, unit="s", values=None, **change):
    values = {**(values or LAWS[law]), **change}
    values |= {f"{name}.{key}": value for name in effects for key, value in EFFECTS[name].items()}
    units = {"time": unit, "input": "V", "output": "um"}
    settings = {**OF_LAWS.get(law, {}), **(settings or {})}
    known = registry.build("models", law, settings)
    own = {name: SETTINGS.get(name) or asdict(registry.build_effects(known, (name,))[0][1]) for name in effects}
    known = System(known, registry.build_effects(known, effects, own)).parameters
    spelled = {parameter.name: parameter.unit_in(units) for parameter in known}
    estimates = {name: Estimate(value, None, spelled[name]) for name, value in values.items()}
    model = FittedModel(
        law,
        settings,
        tuple(effects),
        own,
        units,
        estimates,
    )
    return replace(model, preparation=preparation) if preparation else model


def predicted(model):
    record = Record(TIME, INPUT, None, units=model.units)
    return model.predict(Dataset((record,))).records[0].output


@pytest.fixture(scope="module")
def compiler():
    found = shutil.which("cc") or shutil.which("gcc")
    if found is None:
        pytest.skip("no C compiler")
    return found


def compiled(model, folder, compiler):
    """step over all samples of the C file, and the inverse where there is one, and seconds of the first."""
    source = folder / "model.c"
    loop = """
void all(int n, const double *t, const double *u, double *y) {
    static hysteresis_model model; hysteresis_start(&model);
    for (int i = 0; i < n; i++) y[i] = hysteresis_step(&model, t[i], u[i]);
}
"""
    text = exported(model, "c")
    if "hysteresis_inverse(hysteresis_model" in text:
        loop += """
void back(int n, const double *t, const double *y, double *u) {
    static hysteresis_model model; hysteresis_start(&model);
    for (int i = 0; i < n; i++) u[i] = hysteresis_inverse(&model, t[i], y[i]);
}
"""
    assert "malloc" not in text
    source.write_text(text + loop, encoding="utf-8")
    library = folder / f"model{len(list(folder.iterdir()))}.so"  # a library of one path is loaded once
    flags = ["-std=c99", "-O2", "-Wall", "-Wno-unused", "-Werror", "-shared", "-fPIC"]
    subprocess.run([compiler, *flags, str(source), "-o", str(library), "-lm"], check=True)
    return ctypes.CDLL(str(library))


def called(function, *arrays):
    out = np.empty(arrays[0].size)
    pointers = [array.ctypes.data_as(ctypes.c_void_p) for array in (*arrays, out)]
    function(ctypes.c_int(out.size), *pointers)
    return out


def python_module(text, folder):
    path = folder / "model_alone.py"
    path.write_text(text, encoding="utf-8")
    spec = importlib.util.spec_from_file_location("model_alone", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def close(found, known, tolerance=1e-12):
    np.testing.assert_allclose(found, known, rtol=0, atol=tolerance * float(np.max(np.abs(known))))


CASES = {
    **{law: (law, ()) for law in LAWS},
    **{effect: ("bouc-wen", (effect,)) for effect in EFFECTS},
    "a chain": ("bouc-wen", ("input-lag", "creep", "resonance", "bias")),
    "another chain": ("free-energy", ("backlash", "asymmetry", "saturation", "transport-delay", "record-offset")),
}


@pytest.mark.parametrize("case", CASES)
def test_c_and_python_say_what_predict_says(case, tmp_path, compiler):
    model = fitted(*CASES[case])
    known = predicted(model)
    close(called(compiled(model, tmp_path, compiler).all, TIME, INPUT), known)
    alone = python_module(exported(model, "python"), tmp_path)
    state = alone.start()
    close([alone.step(state, t, u) for t, u in zip(TIME.tolist(), INPUT.tolist(), strict=True)], known)


REFUSED = {
    **dict.fromkeys(
        ("temperature-sensitivity", "thermal-inertia", "response-with-temperature"),
        "a step is given time and input alone",
    ),
    "late-input": "needs the input to come",
    "clock-error": "by its clock the output is ahead",
    **dict.fromkeys(("viscous-damping", "damping-curve", "inertia"), "which needs the next sample"),
}


def test_the_laws_and_effects_that_ship_are_tried_or_refused():
    ours = {name for kind in ("models", "effects") for name in registry.names(kind)
            if registry.load(kind, name).distribution == "hysteresis-bench"}  # fmt: skip
    assert ours == {*LAWS, *EFFECTS, *REFUSED, "description"}
    for name, why in REFUSED.items():
        model = FittedModel(name, {}, (), {}, {"time": "s", "input": "1", "output": "1"}, {})
        around = replace(fitted(), effects=(name,), effect_settings={})
        with pytest.raises(UserError, match=f"{name} cannot be exported: .*{why}"):
            exported(model if name in registry.names("models") else around, "c")


def test_what_depends_on_the_settings_or_the_values_is_refused_with_what_helps():
    term = {"kind": "power", "value": 2.0, "centre": 0.0, "resolution": 1.0, "coefficient": 0.1, "mean": 0.0}
    for model, why in (
        (fitted("lugre", sigma_2=0.004), "--fix sigma_2=0 it can be"),
        (fitted("oscillator", settings={"substeps": 8}), "--set substeps=1 it can be"),
        (fitted("free-energy-gma", settings={"bias_field": None}), "fit with bias_field"),
        (
            replace(fitted(), effects=("description",), effect_settings={"description": {"terms": (term,)}}),
            "made of a whole record",
        ),
    ):
        with pytest.raises(UserError, match=why):
            exported(model, "python")


@pytest.mark.parametrize("law", ["bouc-wen-generalized", "dahl", "maxwell-slip", "prandtl-ishlinskii", "preisach"])
def test_an_oscillator_on_every_spring(law, tmp_path, compiler):
    model = fitted("oscillator", settings={"law": law, "substeps": 1}, values={**MASS, **LAWS[law]})
    close(called(compiled(model, tmp_path, compiler).all, TIME, INPUT), predicted(model), 1e-11)


def test_smoother_loops_to_what_the_kernels_promise(tmp_path, compiler):
    model = fitted(settings={"n": 2.0})
    close(called(compiled(model, tmp_path, compiler).all, TIME, INPUT), predicted(model), 1e-8)


def test_preparation_is_repeated_and_an_index_is_no_time(tmp_path, compiler):
    model = fitted("bouc-wen", ("input-lag", "bias"), Preparation(input_offset=0.5, flip=True))
    close(called(compiled(model, tmp_path, compiler).all, TIME, INPUT), predicted(model))
    index = fitted("hammerstein", ("input-lag", "drift"), unit="sample")
    close(called(compiled(index, tmp_path, compiler).all, TIME, INPUT), predicted(index))


def inverted(model, folder, compiler):
    """The input that C needs for 0.8 of what was predicted, after the model's answer to it and Python are compared."""
    library, known = compiled(model, folder, compiler), predicted(model)
    wanted = known[0] + (known - known[0]) * 0.8
    needed = called(library.back, TIME, wanted)
    close(called(library.all, TIME, needed), wanted)
    alone = python_module(exported(model, "python"), folder)
    state = alone.start()
    close([alone.inverse(state, t, y) for t, y in zip(TIME.tolist(), wanted.tolist(), strict=True)], needed)
    return called(library.back, TIME, known)


CHAINS = (("bias",), ("drift",), ("creep",), ("creep", "drift", "periodic-disturbance", "record-offset"))


@pytest.mark.parametrize("effects", CHAINS, ids=str)
def test_the_inverse_of_c_and_python(effects, tmp_path, compiler):
    model = fitted("bouc-wen", effects, Preparation(input_offset=0.5, flip=True))
    assert "leaves out" not in exported(model, "c")
    inverted(model, tmp_path, compiler)


ONE_WAY = {
    "anticlockwise": ("prandtl-ishlinskii", {}),
    "clockwise": ("prandtl-ishlinskii", {f"w{k}": -0.04 for k in range(1, 13)}),
    "falling": ("prandtl-ishlinskii", {"slope": -0.6, **{f"w{k}": -0.3 / k for k in range(1, 13)}}),
    "with a curve behind": ("prandtl-ishlinskii-modified", {"centre": 0.3, "reach": 1.1}),
    "with a falling curve behind": (
        "prandtl-ishlinskii-modified", {"slope": -1.2, "reach": 1.1, **{f"above{k}": 0.2 for k in (1, 2, 3)}},
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", ONE_WAY)
def test_the_closed_inverse_of_plays(case, tmp_path, compiler):
    law, values = ONE_WAY[case]
    close(inverted(fitted(law, ("bias",), **values), tmp_path, compiler), INPUT, 1e-11)


def test_an_inverse_says_what_it_leaves_out():
    text = " ".join(exported(fitted("bouc-wen", ("input-lag", "saturation", "creep")), "python").split())
    assert "leaves out: saturation." in text
    assert "leaves out: input-lag; undone one sample at a time it would ring" in text
    assert "leaves out: creep" in " ".join(exported(growing(), "c").split())
    staged = " ".join(exported(fitted("hammerstein"), "c").split())
    assert "leaves out: the linear stage of hammerstein; undone one sample at a time it would ring" in staged
    assert "leaves out" not in exported(fitted("hammerstein", unit="sample"), "c")


def growing():
    """A creep that is more than what passes at once: its inverse would grow."""
    model = fitted("bouc-wen", ("creep",))
    share = replace(model.parameters["creep.share"], value=1.2)
    return replace(model, parameters={**model.parameters, "creep.share": share})


@pytest.mark.parametrize(
    ("law", "values"), [("prandtl-ishlinskii", {"w12": -2.0}), ("prandtl-ishlinskii-modified", {"below3": -9.0})]
)
def test_plays_that_turn_round_have_no_inverse(law, values):
    assert "none is exported" in exported(fitted(law, **values), "c")


def test_python_needs_nothing(tmp_path):
    (tmp_path / "alone.py").write_text(exported(fitted("bouc-wen", tuple(EFFECTS)), "python"), encoding="utf-8")
    code = "import sys; sys.path.insert(0, '.'); import alone; alone.step(alone.start(), 0.0, 1.0)"
    code += "; assert 'numpy' not in sys.modules"
    subprocess.run([sys.executable, "-I", "-c", code], cwd=tmp_path, check=True)


@pytest.mark.parametrize(
    ("settings", "values"),
    [
        ({}, {"alpha": -2.0, "beta": 0.3, "gamma": -0.9}),  # bounded, as the rates change places with the sign
        ({"n": 3.7}, {"alpha": -3.0, "beta": 8.84e-4, "gamma": -8.05e-4, "d": 3.315}),  # trial stages overflow
    ],
)
def test_a_clockwise_law_is_exported_as_it_is(settings, values):
    model = fitted(settings=settings, **values)
    jumps = np.where(np.arange(TIME.size) % 40 < 20, 1.0, -1.0) * np.linspace(0.0, 60.0, TIME.size)
    alone: dict = {}
    exec(exported(model, "python"), alone)
    state = alone["start"]()
    answered = np.array([alone["step"](state, t, u) for t, u in zip(TIME.tolist(), jumps.tolist(), strict=True)])
    record = Record(TIME, jumps, None, units=model.units)
    expected = model.predict(Dataset((record,))).records[0].output
    assert np.max(np.abs(answered - expected)) < 1e-8 * np.ptp(expected)


def test_what_cannot_be_exported_says_so():
    for model, words in (
        (fitted(beta=-0.1), "has no bound"),
        (fitted(alpha=-2.0, beta=0.3, gamma=0.9), "beta - gamma below 0"),
        (FittedModel("polynomial", {}, (), {}, {"time": "s"}, {}), "model polynomial cannot be exported"),
        (replace(fitted(), effects=("eddy-current",), effect_settings={}), "acts inside the model's own equation"),
    ):
        with pytest.raises(UserError, match=words):
            exported(model, "c")
    with pytest.raises(UserError, match="no test runs it"):
        exported(fitted(), "fmu")


def test_c_is_fast_enough(tmp_path, compiler):
    """At most twice the compiled kernels' time, in the same run, the best of several: 0.8 to 0.9 was measured."""
    model = fitted("bouc-wen", ("input-lag", "creep", "resonance"))
    library = compiled(model, tmp_path, compiler)
    t = np.linspace(0.0, 50.0, 100_000)
    u = 3.0 * np.sin(2 * np.pi * t)
    system, values, signal = model.system, model.values[:, None], Record(t, u, None).signal
    system.simulate(signal, values)

    taken = {"C": [], "kernels": []}
    runs = {"C": lambda: called(library.all, t, u), "kernels": lambda: system.simulate(signal, values)}
    for _ in range(15):  # in turns, as what else runs here slows both
        for name, run in runs.items():
            before = time.thread_time()
            run()
            taken[name].append(time.thread_time() - before)
    assert min(taken["C"]) <= 2.0 * min(taken["kernels"])


def with_names_of_c(several, register: Array, long):
    """A kernel may call its variables as it likes."""
    short, found = several + 1.0, 2.0 * several
    for int in range(3):
        short += register[int]
    if long > 0.0:
        found = short
    return found, short


def test_words_of_c_are_no_names_of_variables(tmp_path, compiler):
    (function,) = gathered([with_names_of_c])
    kinds = {function.name: [kind for _, kind in function.arguments]}
    array = "double array[] = {1.0, 2.0, 4.0};"
    call = f"void call(double x, double *y) {{ {array} {function.name}(x, array, x, y); }}"
    source, library = tmp_path / "names.c", tmp_path / "names.so"
    source.write_text(f"{c_of(function, kinds)}\n{call}\n", encoding="utf-8")
    subprocess.run([compiler, "-std=c99", "-Wall", "-Werror", "-shared", "-fPIC", source, "-o", library], check=True)
    out = np.empty(2)
    ctypes.CDLL(str(library)).call(ctypes.c_double(3.0), out.ctypes.data_as(ctypes.c_void_p))
    assert tuple(out) == with_names_of_c(3.0, [1.0, 2.0, 4.0], 3.0)


def test_a_unit_cannot_end_the_comment(tmp_path, compiler):
    model = replace(fitted(), units={"time": "s", "input": '*/ int x; """', "output": "um"})
    assert compiled(model, tmp_path, compiler)
    assert python_module(exported(model, "python"), tmp_path).step


def test_the_command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_model(tmp_path / "model.json", fitted("bouc-wen", ("output-lag",)))
    done = CliRunner().invoke(main, ["export", "model.json", "--to", "c"])
    assert done.exit_code == 0, done.output
    assert "It leaves out: output-lag" in " ".join(done.output.split())
    assert (tmp_path / "model.c").is_file()
    again = CliRunner().invoke(main, ["export", "model.json", "--to", "c"])
    assert again.exit_code == 2
    assert "is there already" in again.output
