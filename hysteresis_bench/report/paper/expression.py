"""Arithmetic in a published file: a small language of numbers, names and tables, evaluated without eval.

`mean(table_4.gpmix_error)`, `1 - (log(2) / 70) ** (1/6)`, `c1_ini >= c2_end and c2_ini >= c1_end`. Names are
numbers, lists or tables; a table's columns follow a dot; `[i]` picks one entry, from 0. Lists and drawn
samples are worked element by element, so that the mean of a comparison is a share.
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sqrt": np.sqrt,
    "log": np.log,
    "exp": np.exp,
    "abs": np.abs,
    "mean": np.mean,
    "sum": np.sum,
    "max": np.max,
    "min": np.min,
    "any": np.any,
    "all": np.all,
}

OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
    ast.Not: np.logical_not,
    ast.And: np.logical_and,
    ast.Or: np.logical_or,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}


def evaluate(text: str, names: Mapping[str, Any]) -> Any:
    """The value of an expression: a float, a bool or an array. Raises ValueError telling what is wrong."""
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except SyntaxError as error:
        raise ValueError(f"{text!r} is not an expression: {error.msg}") from None
    try:
        value = _value(tree.body, names)
    except (ArithmeticError, TypeError, LookupError) as error:
        raise ValueError(f"{text!r} cannot be evaluated: {error}") from None
    return value.item() if isinstance(value, np.generic) else value


def _value(node: ast.AST, names: Mapping[str, Any]) -> Any:
    match node:
        case ast.Constant(value=bool() as flag):
            return flag
        case ast.Constant(value=int() | float() as number):
            return float(number)
        case ast.Name(id=name):
            if name not in names:
                raise ValueError(f"nothing is called {name!r}; known: {', '.join(sorted(names)) or 'nothing'}")
            return _number(names[name])
        case ast.List(elts=elements):
            return np.array([_value(element, names) for element in elements])
        case ast.Attribute(value=ast.Name(id=table), attr=column):
            return _column(names, table, column)
        case ast.Subscript(value=values, slice=ast.Constant(value=int() as index)):
            return _value(values, names)[index]
        case ast.UnaryOp(op=sign, operand=operand):
            return _operator(sign)(_value(operand, names))
        case ast.BinOp(left=left, op=between, right=right):
            return _operator(between)(_value(left, names), _value(right, names))
        case ast.BoolOp(op=joint, values=parts):
            found = _value(parts[0], names)
            for part in parts[1:]:
                found = _operator(joint)(found, _value(part, names))
            return found
        case ast.Compare(left=left, ops=relations, comparators=others):
            sides = [_value(side, names) for side in (left, *others)]
            found = True
            for relation, lower, upper in zip(relations, sides, sides[1:], strict=False):
                found = np.logical_and(found, _operator(relation)(lower, upper))
            return found
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in FUNCTIONS:
            return FUNCTIONS[name](*(_value(argument, names) for argument in arguments))
    raise ValueError(f"{ast.unparse(node)!r} is no part of this arithmetic")


def _operator(node: ast.AST) -> Callable[..., Any]:
    if type(node) not in OPERATORS:
        raise ValueError(f"the operator {type(node).__name__} is no part of this arithmetic")
    return OPERATORS[type(node)]


def _number(value: Any) -> Any:
    return np.asarray(value, dtype=float) if isinstance(value, (list, tuple)) else value


def _column(names: Mapping[str, Any], table: str, column: str) -> Any:
    columns = names.get(table)
    if not isinstance(columns, Mapping):
        raise ValueError(f"there is no table {table!r}")
    if column not in columns:
        raise ValueError(f"{table} has no column {column!r}; it has {', '.join(columns)}")
    return _number(columns[column])
