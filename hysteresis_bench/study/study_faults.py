"""What a study file names that does not exist or does not fit: plugins, settings, parameters, experiments, losses."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hysteresis_bench import registry
from hysteresis_bench.compose import System
from hysteresis_bench.errors import nearest
from hysteresis_bench.fit.loss import LOSSES
from hysteresis_bench.parameters import Parameter
from hysteresis_bench.study.strict import listed, table, tables


def content_faults(raw: dict[str, Any]) -> list[str]:
    """Of parsed TOML, a sentence each, wherever the file's form lets it be read."""
    found = []
    for number, spec in enumerate(tables(raw, "optimizer"), 1):
        if isinstance(spec.get("plugin"), str):
            faults = registry.faults("optimizers", spec["plugin"], table(spec, "settings"))
            found += [f"[[optimizer]] {number}: {fault}" for fault in faults]
    for number, spec in enumerate(tables(raw, "problem"), 1):
        found += [
            f"[[problem]] {number}: {fault}"
            for fault in [*problem_faults(spec), *_twice(spec), *_label_faults(spec, raw)]
        ]
    for number, spec in enumerate(tables(raw, "stage"), 1):
        found += [f"[[stage]] {number}: {fault}" for fault in _stage_faults(spec, raw)]
    if isinstance(raw.get("closing"), dict):
        found += [f"[closing]: {fault}" for fault in _closing_faults(raw["closing"], raw)]
    found += [*_reference_faults(raw), *_instance_faults(raw), *_unprintable(raw), *_outside(raw.get("published"))]
    found += doubles("optimizer", _labels(raw))
    for key in ("problem", "stage"):
        found += doubles(key, [str(each["name"]) for each in tables(raw, key) if "name" in each])
    return found


def doubles(key: str, names: Sequence[str]) -> list[str]:
    """A sentence on every name that two tables of a [[key]] share."""
    word = "label" if key == "optimizer" else "name"
    return [
        f'two [[{key}]] are both called "{name}"; give one another {word}.'
        for name in sorted({name for name in names if names.count(name) > 1})
    ]


def _unprintable(raw: dict[str, Any]) -> list[str]:
    """Names go into file names, tables and terminals."""
    told = [("optimizer", "label"), ("problem", "name"), ("stage", "name")]
    return [
        f"[[{key}]] {number}: {word} = {text!r} has characters that cannot be printed; leave them out."
        for key, word in told
        for number, each in enumerate(tables(raw, key), 1)
        if isinstance(text := each.get(word), str) and not text.isprintable()
    ]


def _outside(published: Any) -> list[str]:
    """The file is copied into the results: it has to lie beside the study, or below it."""
    if not isinstance(published, str) or not (Path(published).is_absolute() or ".." in Path(published).parts):
        return []
    return [f'published = "{published}" lies outside the study\'s folder; put the file beside the study.']


def _twice(spec: dict[str, Any]) -> list[str]:
    """What a problem lists twice, or fits and holds out."""
    found = []
    for keys in (("fitted", "held_out"), ("optimizers",), ("effects",), ("data",)):
        names = [name for key in keys for name in listed(spec, key)]
        more = "; what is held out must not be fitted" if len(keys) > 1 else ""
        doubled = dict.fromkeys(name for name in names if names.count(name) > 1)
        found += [f'{" and ".join(keys)}: "{name}" is named twice{more}.' for name in doubled]
    return found


def problem_faults(spec: dict[str, Any], experiments: Sequence[str] = ("fitted", "held_out")) -> list[str]:
    """Of a table that names a model, effects, a rig or a loss; experiments : keys under which it lists the rig's."""
    found = []
    if isinstance(spec.get("model"), str):
        faults = registry.faults("models", spec["model"], table(spec, "settings"))
        found += faults or _bound_faults(spec)
    for effect in listed(spec, "effects"):
        found += registry.effect_faults(effect, str(spec.get("model")))
    if isinstance(spec.get("rig"), str):
        faults = registry.faults("rigs", spec["rig"], table(spec, "rig_settings"))
        found += faults
        if not faults:
            rig = registry.build("rigs", spec["rig"], table(spec, "rig_settings"))
            for key in experiments:
                for experiment in listed(spec, key):
                    if experiment not in rig.experiments:
                        known = nearest(experiment, rig.experiments)
                        found.append(f'{key}: rig {spec["rig"]} has no experiment "{experiment}". {known}')
            found += _range_faults(spec)
    if spec.get("loss", "rmse") not in LOSSES:
        found.append(f'no loss "{spec["loss"]}". {nearest(str(spec["loss"]), LOSSES)}')
    return found


def _range_faults(spec: dict[str, Any]) -> list[str]:
    """Of a problem on a rig: every end of a range must make one."""
    found = []
    for name, pair in table(spec, "ranges").items():
        if not (isinstance(pair, list) and len(pair) == 2 and all(isinstance(end, (int, float)) for end in pair)):
            continue
        if not pair[0] < pair[1]:
            found.append(f"ranges: {name}: {pair[0]} must be below {pair[1]}.")
        for end in pair:
            settings = table(spec, "rig_settings") | {name: end}
            found += [f"ranges: {name} = {end}: {fault}" for fault in registry.faults("rigs", spec["rig"], settings)]
    return found


def _instance_faults(raw: dict[str, Any]) -> list[str]:
    """Only a rig has instances."""
    found = [
        f"[[problem]] {number}: {key}: only a rig can be drawn anew; measured data are one instance."
        for number, spec in enumerate(tables(raw, "problem"), 1)
        for key in ("instances", "ranges")
        if key in spec and "rig" not in spec
    ]
    if raw.get("instances", 1) != 1 and not any("rig" in spec for spec in tables(raw, "problem")):
        found.append("instances: no problem has a rig; measured data are one instance.")
    return found


def _labels(raw: dict[str, Any]) -> list[str]:
    return [str(each.get("label") or each.get("plugin")) for each in tables(raw, "optimizer")]


def _reference_faults(raw: dict[str, Any]) -> list[str]:
    """The others are compared with it. Where none is named, a study may do without."""
    labels, named = _labels(raw), raw.get("reference")
    if not labels or not isinstance(named, str) or named in labels:
        return []
    return [f'reference: no optimizer "{named}" in this study. {nearest(named, labels)}']


def _label_faults(spec: dict[str, Any], raw: dict[str, Any]) -> list[str]:
    labels = _labels(raw)
    wanted = [label for label in listed(spec, "optimizers") if label not in labels]
    return [f'optimizers: no optimizer "{label}" in this study. {nearest(label, labels)}' for label in wanted]


def _stage_faults(spec: dict[str, Any], raw: dict[str, Any]) -> list[str]:
    problems = {str(each.get("name")): each for each in tables(raw, "problem")}
    found = _label_faults(spec, raw)
    for key in ("after", "beside"):
        if key in spec and spec[key] not in problems:
            found.append(f'{key}: no problem "{spec[key]}". {nearest(str(spec[key]), problems)}')
    for label in set(listed(spec, "control")) - set(listed(spec, "optimizers")):
        found.append(f'control: "{label}" is not among the optimizers of this stage.')
    if spec.get("control") and "after" in spec and not problems.get(str(spec["after"]), {}).get("rig"):
        found.append(f'control: "{spec["after"]}" has no rig to control.')
    found += _controller_faults(spec)
    source = {key: value for key, value in problems.get(str(spec.get("after")), {}).items() if key.startswith("rig")}
    found += problem_faults(source | {"fitted": listed(spec, "fitted"), "held_out": listed(spec, "check")})
    names, known = _parameter_names(spec), _parameter_names(problems.get(str(spec.get("after")), {}))
    if "model" not in spec:  # the file's form says so already
        return found
    if not names:
        return found + registry.faults("models", str(spec["model"]), table(spec, "settings"))
    fit = listed(spec, "fit")
    found += [
        f'fit: {spec["model"]} has no parameter "{name}". {nearest(name, names)}' for name in fit if name not in names
    ]
    if sorted(fit, key=[*names, *fit].index) != fit:
        found.append(f"fit: name the parameters in the model's order: {', '.join(names)}.")
    for name in names:
        if known and name not in (*fit, *known):
            found.append(f'{name} of {spec["model"]} is neither in fit nor found by "{spec["after"]}".')
    return found


def _controller_faults(spec: dict[str, Any]) -> list[str]:
    if not (asked := listed(spec, "controllers")):
        return []
    from hysteresis_bench.control.bench import MEANINGS

    unknown = [name for name in asked if name not in MEANINGS]
    found = [f'controllers: no controller "{name}". {nearest(name, MEANINGS)}' for name in unknown]
    return found if listed(spec, "control") else [*found, "controllers: without control there is nobody to run them."]


def _closing_faults(spec: dict[str, Any], raw: dict[str, Any]) -> list[str]:
    problems = {str(each.get("name")): each for each in tables(raw, "problem")}
    after = str(spec.get("after") or next(iter(problems), ""))
    found = []
    if "after" in spec and after not in problems:
        found.append(f'after: no problem "{after}". {nearest(after, problems)}')
    rig = {key: value for key, value in problems.get(after, {}).items() if key.startswith("rig")}
    if registry.faults("rigs", str(rig.get("rig")), table(rig, "rig_settings")):
        rig = {}  # the problem's own faults say so already
    names = {key: listed(spec, key) for key in ("fitted", "held_out", "effects")}
    model: dict[str, Any] = {key: spec[key] for key in ("model", "settings") if key in spec}
    found += problem_faults({**rig, **model, **names})
    asked = [*names["fitted"], *names["held_out"]]
    for name in dict.fromkeys(name for name in asked if asked.count(name) > 1):
        found.append(f'"{name}" is named twice; what is held out must not be fitted.')
    return found


def _parameter_names(spec: dict[str, Any]) -> list[str]:
    """The parameters of a problem's or a stage's model; none where it cannot be built."""
    model, settings = spec.get("model"), table(spec, "settings")
    if not isinstance(model, str) or registry.faults("models", model, settings):
        return []
    return [parameter.name for parameter in registry.build("models", model, settings).parameters]


def _bound_faults(spec: dict[str, Any]) -> list[str]:
    model, effects = registry.build("models", spec["model"], table(spec, "settings")), listed(spec, "effects")
    built = not any(registry.effect_faults(effect, spec["model"]) for effect in effects)
    system = System(model, registry.build_effects(model, effects) if built else (), {})
    parameters = {parameter.name: parameter for parameter in system.parameters}
    whole = f"{spec['model']} with {', '.join(effects)}" if effects else spec["model"]
    found = []
    for key in ("bounds", "fixed", "profile"):
        values = spec.get(key, {})
        for name in values if isinstance(values, (dict, list)) else ():
            if name not in parameters and (built or "." not in name):
                found.append(f'{key}: {whole} has no parameter "{name}". {nearest(name, parameters)}')
    for name, value in table(spec, "fixed").items():
        known = parameters.get(name, Parameter(name, 0.0, 1.0))
        found += [f"fixed {fault}" for fault in [known.refuses(value)] if fault]
    for name, pair in table(spec, "bounds").items():
        numbers = isinstance(pair, list) and len(pair) == 2 and all(isinstance(x, (int, float)) for x in pair)
        if name in parameters and numbers:
            scaling = spec.get("scaling") or None
            if scaling in (None, "linear", "log"):
                found += [f"bounds {fault}" for fault in parameters[name].bounded(pair[0], pair[1], scaling).faults()]
    return found
