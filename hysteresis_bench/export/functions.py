"""The functions that a step needs, with all that they call, as syntax trees to be written in another language.

What is exported is the very code that simulates: the kernels' functions of one particle, without their compiler. They
keep to numbers, arrays of numbers, `if`, `while`, `for ... in range`, and the functions of `math`.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from types import FunctionType
from typing import Any

ARRAY, WHOLE = "Array", "int"


@dataclass(frozen=True, eq=False)
class Function:
    """name : unlike that of any other;  tree : its definition
    calls : names in its code -> other functions' names;  numbers : names in its code -> constants
    returns : how many numbers
    """

    name: str
    tree: ast.FunctionDef
    calls: dict[str, str] = field(default_factory=dict)
    numbers: dict[str, float] = field(default_factory=dict)
    returns: int = 1

    @property
    def arguments(self) -> list[tuple[str, str]]:
        """Name and annotation of every argument; a number where there is none."""
        return [(one.arg, ast.unparse(one.annotation) if one.annotation else "float") for one in self.tree.args.args]

    @property
    def summary(self) -> str:
        """The first line of its docstring."""
        return (ast.get_docstring(self.tree) or "").split("\n")[0]


def name_of(function: Callable[..., Any]) -> str:
    """`bouc_wen_step` and `moved` -> "bouc_wen_step_moved"; exports of plugins end in "_export"."""
    plain = getattr(function, "py_func", function)
    *rooms, module = plain.__module__.split(".")
    return f"{module}{'_export' if rooms[-1:] == ['exports'] else ''}_{plain.__name__.strip('_')}"


def gathered(roots: Sequence[Callable[..., Any]]) -> list[Function]:
    """These functions and all that they call, callees first."""
    found: dict[str, Function] = {}

    def gather(function: Callable[..., Any]) -> Function:
        name = name_of(function)
        if name not in found:
            plain = getattr(function, "py_func", function)
            (tree,) = ast.parse(textwrap.dedent(inspect.getsource(plain))).body
            assert isinstance(tree, ast.FunctionDef)
            made = Function(name, tree, returns=_returned(tree))
            for node in (one for statement in tree.body for one in ast.walk(statement)):
                if isinstance(node, ast.Name) and node.id in plain.__globals__:
                    value = plain.__globals__[node.id]
                    if isinstance(value, (int, float)):
                        made.numbers[node.id] = value
                    elif isinstance(getattr(value, "py_func", value), FunctionType):
                        made.calls[node.id] = gather(value).name
            found[name] = made
        return found[name]

    for root in roots:
        gather(root)
    return list(found.values())


def _returned(tree: ast.FunctionDef) -> int:
    returns = [node.value for node in ast.walk(tree) if isinstance(node, ast.Return)]
    return len(returns[0].elts) if returns and isinstance(returns[0], ast.Tuple) else 1
