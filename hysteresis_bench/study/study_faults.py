"""What a study file names that does not exist or does not fit: plugins, settings, parameters, experiments, losses."""

from __future__ import annotations

from typing import Any

from hysteresis_bench import registry
from hysteresis_bench.errors import nearest
from hysteresis_bench.fit.loss import LOSSES


def content_faults(raw: dict[str, Any]) -> list[str]:
    """Of parsed TOML, a sentence each, wherever the file's form lets it be read."""
    found = []
    for number, spec in enumerate(_tables(raw, "optimizer"), 1):
        if isinstance(spec.get("plugin"), str):
            faults = registry.faults("optimizers", spec["plugin"], spec.get("settings", {}))
            found += [f"[[optimizer]] {number}: {fault}" for fault in faults]
    for number, spec in enumerate(_tables(raw, "problem"), 1):
        found += [f"[[problem]] {number}: {fault}" for fault in _problem_faults(spec) + _label_faults(spec, raw)]
    for number, spec in enumerate(_tables(raw, "stage"), 1):
        found += [f"[[stage]] {number}: {fault}" for fault in _stage_faults(spec, raw)]
    if isinstance(raw.get("closing"), dict):
        found += [f"[closing]: {fault}" for fault in _closing_faults(raw["closing"], raw)]
    return found


def _tables(raw: dict[str, Any], key: str) -> list[dict[str, Any]]:
    value = raw.get(key, [])
    return [entry for entry in value if isinstance(entry, dict)] if isinstance(value, list) else []


def _problem_faults(spec: dict[str, Any]) -> list[str]:
    found = []
    if isinstance(spec.get("model"), str):
        faults = registry.faults("models", spec["model"], spec.get("settings", {}))
        found += faults or _bound_faults(spec)
    for effect in spec.get("effects", []):
        found += registry.effect_faults(effect, str(spec.get("model")))
    if isinstance(spec.get("rig"), str):
        faults = registry.faults("rigs", spec["rig"], spec.get("rig_settings", {}))
        found += faults
        if not faults:
            rig = registry.build("rigs", spec["rig"], spec.get("rig_settings", {}))
            for key in ("fitted", "held_out"):
                for experiment in spec.get(key, []):
                    if experiment not in rig.experiments:
                        known = nearest(str(experiment), rig.experiments)
                        found.append(f'{key}: rig {spec["rig"]} has no experiment "{experiment}". {known}')
    if spec.get("loss", "rmse") not in LOSSES:
        found.append(f'no loss "{spec["loss"]}". {nearest(str(spec["loss"]), LOSSES)}')
    return found


def _listed(spec: dict[str, Any], key: str) -> list[str]:
    value = spec.get(key, [])
    return [str(entry) for entry in value] if isinstance(value, list) else []


def _label_faults(spec: dict[str, Any], raw: dict[str, Any]) -> list[str]:
    labels = [str(each.get("label") or each.get("plugin")) for each in _tables(raw, "optimizer")]
    wanted = [label for label in _listed(spec, "optimizers") if label not in labels]
    return [f'optimizers: no optimizer "{label}" in this study. {nearest(label, labels)}' for label in wanted]


def _stage_faults(spec: dict[str, Any], raw: dict[str, Any]) -> list[str]:
    problems = {str(each.get("name")): each for each in _tables(raw, "problem")}
    found = _label_faults(spec, raw)
    for key in ("after", "beside"):
        if key in spec and spec[key] not in problems:
            found.append(f'{key}: no problem "{spec[key]}". {nearest(str(spec[key]), problems)}')
    for label in set(_listed(spec, "control")) - set(_listed(spec, "optimizers")):
        found.append(f'control: "{label}" is not among the optimizers of this stage.')
    if spec.get("control") and not problems.get(str(spec.get("after")), {}).get("rig"):
        found.append(f'control: "{spec.get("after")}" has no rig to control.')
    source = {key: value for key, value in problems.get(str(spec.get("after")), {}).items() if key.startswith("rig")}
    found += _problem_faults(source | {"fitted": _listed(spec, "fitted"), "held_out": _listed(spec, "check")})
    names, known = _parameter_names(spec), _parameter_names(problems.get(str(spec.get("after")), {}))
    if not names:
        return found + registry.faults("models", str(spec.get("model")), spec.get("settings", {}))
    fit = _listed(spec, "fit")
    found += [
        f'fit: {spec["model"]} has no parameter "{name}". {nearest(name, names)}' for name in fit if name not in names
    ]
    if sorted(fit, key=[*names, *fit].index) != fit:
        found.append(f"fit: name the parameters in the model's order: {', '.join(names)}.")
    for name in names:
        if known and name not in (*fit, *known):
            found.append(f'{name} of {spec["model"]} is neither in fit nor found by "{spec["after"]}".')
    return found


def _closing_faults(spec: dict[str, Any], raw: dict[str, Any]) -> list[str]:
    problems = {str(each.get("name")): each for each in _tables(raw, "problem")}
    after = str(spec.get("after") or next(iter(problems), ""))
    found = []
    if "after" in spec and after not in problems:
        found.append(f'after: no problem "{after}". {nearest(after, problems)}')
    rig = {key: value for key, value in problems.get(after, {}).items() if key.startswith("rig")}
    if registry.faults("rigs", str(rig.get("rig")), rig.get("rig_settings", {})):
        rig = {}  # told of the problem already
    names = {key: _listed(spec, key) for key in ("fitted", "held_out", "effects")}
    model: dict[str, Any] = {key: spec[key] for key in ("model", "settings") if key in spec}
    found += _problem_faults({**rig, **model, **names})
    asked = [*names["fitted"], *names["held_out"]]
    for name in dict.fromkeys(name for name in asked if asked.count(name) > 1):
        found.append(f'"{name}" is named twice; what is held out must not be fitted.')
    return found


def _parameter_names(spec: dict[str, Any]) -> list[str]:
    """The parameters of a problem's or a stage's model; none where it cannot be built."""
    model, settings = spec.get("model"), spec.get("settings", {})
    if not isinstance(model, str) or registry.faults("models", model, settings):
        return []
    return [parameter.name for parameter in registry.build("models", model, settings).parameters]


def _bound_faults(spec: dict[str, Any]) -> list[str]:
    model = registry.build("models", spec["model"], spec.get("settings", {}))
    parameters = {parameter.name: parameter for parameter in model.parameters}
    found = []
    for key in ("bounds", "fixed", "profile"):
        values = spec.get(key, {})
        for name in values if isinstance(values, (dict, list)) else ():
            if name not in parameters and "." not in name:
                found.append(f'{key}: {spec["model"]} has no parameter "{name}". {nearest(name, parameters)}')
    for name, pair in spec.get("bounds", {}).items():
        numbers = isinstance(pair, list) and len(pair) == 2 and all(isinstance(x, (int, float)) for x in pair)
        if name in parameters and numbers:
            scaling = spec.get("scaling") or parameters[name].scaling
            if scaling in ("linear", "log"):
                found += [f"bounds {fault}" for fault in parameters[name].within(*pair, scaling).faults()]
    return found
