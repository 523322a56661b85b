"""A fitted model as one file in another language: Python that imports `math`, or C99 without allocation."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from re import sub
from textwrap import wrap

from hysteresis_bench.control.linear_dynamics import AFTER, BEFORE
from hysteresis_bench.errors import UserError
from hysteresis_bench.export.chain import Chain, chain_of
from hysteresis_bench.export.functions import gathered, name_of
from hysteresis_bench.export.to_c import HELPERS, c_of, number, prototype
from hysteresis_bench.export.to_python import POWER, python_of
from hysteresis_bench.fit.model_file import FittedModel

SUFFIXES: Mapping[str, str] = {"python": ".py", "c": ".c"}
REFUSED = ("fmu", "matlab", "simulink", "opensees", "julia", "rust")
"""Targets that are asked for and that no test runs."""


def exported(fitted: FittedModel, target: str) -> str:
    """The file's text. Raises UserError for an unknown target, and for what cannot be exported, all of it."""
    if target not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        why = "no test runs it, so it is not offered" if target.lower() in REFUSED else "is not known"
        raise UserError("export", f'target "{target}": {why}. Known: {known}; C is what other tools can call.')
    chain = chain_of(fitted)
    return _python(chain) if target == "python" else _c(chain)


def notes(chain: Chain) -> list[str]:
    """What the file is, a sentence each: for its head, and for the terminal."""
    fitted = chain.fitted
    effects = f" with {', '.join(fitted.effects)}" if fitted.effects else ""
    stated = ((name, fitted.units[name]) for name in ("time", "input", "output"))
    units = ", ".join(f"{name} without a unit" if unit == "1" else f"{name} in {unit}" for name, unit in stated)
    said = [
        f"{fitted.model}{effects}, exported by hysteresis-bench. {units}.",
        "step(model, time, input) takes one sample and gives the output; time must rise from call to call.",
        "It starts at rest with its first sample, as every record does.",
    ]
    if fitted.preparation.settle:
        said.append(
            f"In the fit closed loops were passed {fitted.preparation.settle} times before they were scored: pass "
            f"yours as often."
        )
    if fitted.preparation.steps > 1:
        said.append(
            f"In the fit {fitted.preparation.steps} steps were simulated from one sample to the next, along a smooth "
            "input: call step as often, or it is less exact than predict."
        )
    if chain.ignored is None:
        said.append("The law has no exact inverse that is known, or none with these parameters: none is exported.")
    else:
        said.append(
            "inverse(model, time, output) takes the wanted output and gives the input; use a model of its own for it."
        )
        said += _left_out(chain)
    return said


def _left_out(chain: Chain) -> list[str]:
    """What the inverse does not undo, and why."""
    linear = [(name, effect) for name, effect in chain.fitted.system.effects if effect.affine]
    dynamics = {name for name, effect in linear if effect.family in (BEFORE, AFTER)}
    own = chain.law.part.not_undone
    late = [*([own] if own else []), *(name for name in chain.ignored or () if name in dynamics)]
    rest = [name for name in chain.ignored or () if name not in dynamics]
    said = [f"It leaves out: {', '.join(rest)}."] if rest else []
    if late:
        said.append(
            f"It leaves out: {', '.join(late)}; undone one sample at a time it would ring at the rate of the samples, "
            f"or need samples to come. `hysteresis-bench control --reference` undoes it ahead."
        )
    return said


def _head(chain: Chain, indent: str) -> str:
    """The notes as lines of a comment, which a unit's text cannot end."""
    lines = [line for note in notes(chain) for line in wrap(note, 100)]
    safe = "\n".join(f"{indent}{line}".rstrip() for line in lines)
    return safe.replace("*/", "* /").replace('"', "'").replace("\\", "/").strip()


def _call(link_name: str, state: int, constants: int, given: str, mark: str) -> str:
    return f"{link_name}({mark.format('s', state)}, {mark.format('p', constants)}, {given})"


def _lines(chain: Chain, mark: str) -> tuple[list[str], list[str]]:
    """The statements of a step and of the inverse; mark : how a part of an array is written."""
    step, undo = [], []
    for k, link in enumerate(reversed(chain.effects)):
        step.append(f"u{k + 1} = u{k}")
        if (function := link.function("before")) is not None:
            step[-1] = f"u{k + 1} = {_call(name_of(function), link.state, link.constants, f't, u{k}', mark)}"
    inner = len(chain.effects)
    law = chain.law.function("law")
    assert law is not None
    step.append(f"y = {_call(name_of(law), chain.law.state, chain.law.constants, f't, u{inner}', mark)}")
    for k, link in enumerate(chain.effects):
        if (function := link.function("after")) is not None:
            given = f"t, u{inner - 1 - k}, y"
            step.append(f"y = {_call(name_of(function), link.state, link.constants, given, mark)}")
    if chain.ignored is not None:
        for link in reversed(chain.effects):
            if link.part.invertible and (function := link.function("undone")) is not None:
                undo.append(f"v = {_call(name_of(function), link.state, link.constants, 't, v', mark)}")
        function = chain.law.function("inverse")
        assert function is not None
        undo.append(f"u = {_call(name_of(function), chain.law.state, chain.law.constants, 'v', mark)}")
    return step, undo


def _python(chain: Chain) -> str:
    step, undo = _lines(chain, "{}[{}]")
    prepared = chain.fitted.preparation
    sign = -1.0 if prepared.flip else 1.0
    views = [(link.state, link.part.state, link.constants, len(link.part.constants)) for link in chain.links]
    functions = [python_of(function) for function in gathered(chain.roots)]
    body = "\n\n\n".join([POWER, *functions] if any("raised_to(" in one for one in functions) else functions)
    for state, _, constants, _ in views:
        index = [(one[0], one[2]) for one in views].index((state, constants))
        step = [line.replace(f"s[{state}], p[{constants}]", f"s[{index}], p[{index}]") for line in step]
        undo = [line.replace(f"s[{state}], p[{constants}]", f"s[{index}], p[{index}]") for line in undo]
    head = _head(chain, "")
    values = "\n".join(f"    {list(link.part.constants)!r},  # {link.name}" for link in chain.links)
    values = values.replace("inf", "math.inf")
    inverse = (
        f'''

def inverse(model, time, output):
    """The input that makes the output, one sample on."""
    s, p, t, v = model, CONSTANTS, time, output
    {chr(10).join("    " + line for line in undo).strip()}
    return {sign!r} * u + {prepared.input_offset!r}
'''
        if undo
        else ""
    )
    return f'''"""{head}"""

import math

CONSTANTS = (
{values}
)


def start():
    """A model at rest before its first sample."""
    return [[0.0] * size for size in ({", ".join(str(link.part.state) for link in chain.links)},)]


def step(model, time, input):
    """The output, one sample on."""
    s, p, t = model, CONSTANTS, time
    u0 = {sign!r} * (input - {prepared.input_offset!r})
    {chr(10).join("    " + line for line in step).strip()}
    return y
{inverse}

{body}
'''


def _c(chain: Chain) -> str:
    step, undo = _lines(chain, "{}->{}")
    functions = gathered(chain.roots)
    kinds = {function.name: [kind for _, kind in function.arguments] for function in functions}
    prepared = chain.fitted.preparation
    sign = "-1.0" if prepared.flip else "1.0"
    step, undo = (
        [line.replace("s->", "model->s + ").replace("p->", "(double *)CONSTANTS + ") for line in lines]
        for lines in (step, undo)
    )
    body = "\n\n".join(c_of(function, kinds) for function in functions)
    inputs = ", ".join(f"u{k}" for k in range(1, len(chain.effects) + 1))
    inverse = (
        f"""

double hysteresis_inverse(hysteresis_model *model, double time, double output) {{
    double u, t = time, v = output;
    (void)t;
    {(";" + chr(10) + "    ").join(undo)};
    return {sign} * u + {number(prepared.input_offset)};
}}"""
        if undo
        else ""
    )
    head = sub(r"\b(step|inverse)\(", r"hysteresis_\1(", _head(chain, "   "))
    return f"""/* {head}
   hysteresis_start(&model) puts a model at rest before its first sample. C99; link with -lm. */

#include <math.h>

typedef struct {{ double s[{max(chain.state, 1)}]; }} hysteresis_model;

static const double CONSTANTS[] = {{{", ".join(map(number, chain.constants)) or "0.0"}}};

{HELPERS}
{chr(10).join(prototype(function) + ";" for function in functions)}

{body}

void hysteresis_start(hysteresis_model *model) {{
    for (int i = 0; i < {max(chain.state, 1)}; i++) model->s[i] = 0.0;
}}

double hysteresis_step(hysteresis_model *model, double time, double input) {{
    double t = time, u0 = {sign} * (input - {number(prepared.input_offset)}), y{", " + inputs if inputs else ""};
    (void)t;
    {(";" + chr(10) + "    ").join(step)};
    return y;
}}{inverse}
"""


def write_export(path: Path, fitted: FittedModel, target: str) -> list[str]:
    """Write the file; returns what it is, a sentence each. Raises UserError as `exported`."""
    path.write_text(exported(fitted, target), encoding="utf-8")
    return notes(chain_of(fitted))
