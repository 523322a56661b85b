"""Functions as C99: numbers are double, arrays are pointers, several results are written to a pointer."""

from __future__ import annotations

import ast
import math
from collections.abc import Iterator, Mapping

from hysteresis_bench.export.functions import ARRAY, WHOLE, Function

OPERATORS: Mapping[type[ast.AST], str] = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Mod: "%",
    ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!=",
    ast.And: "&&", ast.Or: "||", ast.BitAnd: "&", ast.USub: "-", ast.Not: "!", ast.UAdd: "+",
}  # fmt: skip
ATTRIBUTES = {"inf": "INFINITY", "nan": "NAN", "pi": "3.141592653589793"}
BUILTINS = {"abs": "fabs", "min": "smaller", "max": "larger", "int": "(int)"}
HELPERS = """static inline double smaller(double a, double b) { return b < a ? b : a; }
static inline double larger(double a, double b) { return b > a ? b : a; }"""
WORDS = """auto break case char const continue default do double else enum extern float for goto if inline int long
register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while"""
TAKEN = frozenset((*WORDS.split(), "several", "found", "result", "i_"))
"""Words of C99, and names that are written here."""


def number(value: float) -> str:
    """A number as C writes it, to the last bit."""
    if math.isnan(value):
        return "NAN"
    if math.isinf(value):
        return "INFINITY" if value > 0 else "-INFINITY"
    return repr(float(value))


def named(name: str) -> str:
    """A variable's name, another where C has taken it."""
    return f"{name}_" if name in TAKEN else name


def c_of(function: Function, kinds: Mapping[str, list[str]]) -> str:
    """The definition; kinds : of the arguments of every function."""
    return _Writer(function, kinds).definition()


def prototype(function: Function) -> str:
    """The first line of a definition."""
    kinds = {ARRAY: "double *", WHOLE: "int "}
    given = [f"{kinds.get(kind, 'double ')}{named(name)}" for name, kind in function.arguments]
    several = function.returns > 1
    return (
        f"static inline {'void' if several else 'double'} {function.name}"
        f"({', '.join([*given, *(['double *result'] if several else [])])})"
    )


class _Writer:
    def __init__(self, function: Function, kinds: Mapping[str, list[str]]) -> None:
        self.function, self.kinds = function, kinds
        arguments = dict(function.arguments)
        nodes = list(ast.walk(function.tree))
        loops = {node.target.id for node in nodes if isinstance(node, ast.For) and isinstance(node.target, ast.Name)}
        typed = {
            node.target.id for node in nodes if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)
        }
        self.whole = {name for name, kind in arguments.items() if kind == WHOLE} | loops | typed
        stored = {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
        self.locals = sorted(stored - set(arguments) - loops)
        self.results = 0

    def definition(self) -> str:
        body = [line for node in self.function.tree.body for line in self.statement(node)]
        made = [f"{'int' if name in self.whole else 'double'} {named(name)};" for name in self.locals]
        temporary = [f"double several[{self.results}];"] if self.results else []
        lines = ["    " + line for line in (*made, *temporary, *body)]
        comment = f"/* {self.function.summary} */\n" if self.function.summary else ""
        return comment + prototype(self.function) + " {\n" + "\n".join(lines) + "\n}"

    def block(self, nodes: list[ast.stmt]) -> Iterator[str]:
        for node in nodes:
            for line in self.statement(node):
                yield "    " + line

    def statement(self, node: ast.stmt) -> Iterator[str]:
        match node:
            case ast.Expr(ast.Constant()):
                return
            case ast.Expr(ast.Call() as call):
                yield f"{self.call(call)};"
            case ast.Assign([ast.Tuple(targets)], ast.Tuple(values)):
                self.results = max(self.results, len(values))
                yield from (f"several[{i}] = {self.expression(value)};" for i, value in enumerate(values))
                yield from (f"{self.expression(one)} = several[{i}];" for i, one in enumerate(targets))
            case ast.Assign([ast.Tuple(targets)], ast.Call() as call):
                self.results = max(self.results, len(targets))
                yield f"{self.call(call, extra='several')};"
                yield from (f"{self.expression(one)} = several[{i}];" for i, one in enumerate(targets))
            case ast.Assign(targets, value):
                said = " = ".join(self.expression(one) for one in targets)
                yield f"{said} = {self.expression(value, self.is_whole(targets[0]))};"
            case ast.AnnAssign(target, _, value) if value is not None:
                yield f"{self.expression(target)} = {self.expression(value, True)};"
            case ast.AugAssign(target, operator, value):
                right = self.expression(value, self.is_whole(target))
                yield f"{self.expression(target)} {OPERATORS[type(operator)]}= {right};"
            case ast.If(test, body, otherwise):
                yield f"if ({self.expression(test)}) {{"
                yield from self.block(body)
                yield from (["} else {", *self.block(otherwise), "}"] if otherwise else ["}"])
            case ast.While(test, body, []):
                yield f"while ({self.expression(test)}) {{"
                yield from self.block(body)
                yield "}"
            case ast.For(ast.Name(name), ast.Call(ast.Name("range"), bounds), body, []):
                low = "0" if len(bounds) == 1 else self.expression(bounds[0], True)
                high = self.expression(bounds[-1], True)
                counter = named(name)
                yield f"for (int {counter} = {low}; {counter} < {high}; {counter}++) {{"
                yield from self.block(body)
                yield "}"
            case ast.Return(ast.Tuple(values)):
                yield "{"
                yield f"    const double found[] = {{{', '.join(map(self.expression, values))}}};"
                yield f"    for (int i_ = 0; i_ < {len(values)}; i_++) result[i_] = found[i_];"
                yield "    return;"
                yield "}"
            case ast.Return(ast.expr() as value):
                yield f"return {self.expression(value)};"
            case ast.Break() | ast.Continue():
                yield f"{ast.unparse(node)};"
            case _:
                raise NotImplementedError(f"{self.function.name}: {ast.unparse(node)}")

    def is_whole(self, node: ast.expr) -> bool:
        return isinstance(node, ast.Name) and node.id in self.whole

    def expression(self, node: ast.expr, whole: bool = False) -> str:
        """whole : numbers are written as integers"""
        match node:
            case ast.Constant(bool() as value):
                return str(int(value))
            case ast.Constant(value):
                return str(value) if whole else number(float(str(value)))
            case ast.Name(name):
                constant = self.function.numbers.get(name)
                if constant is None or name in self.locals:
                    return named(name)
                return str(int(constant)) if whole else number(constant)
            case ast.Attribute(_, name):
                return ATTRIBUTES[name]
            case ast.Subscript(value, index):
                return f"{self.expression(value)}[{self.expression(index, True)}]"
            case ast.UnaryOp(operator, operand):
                return f"({OPERATORS[type(operator)]}{self.expression(operand, whole)})"
            case ast.BinOp(left, ast.Pow(), ast.Constant(2)):
                return f"({self.expression(left)} * {self.expression(left)})"
            case ast.BinOp(left, ast.Pow(), right):
                return f"pow({self.expression(left)}, {self.expression(right)})"
            case ast.BinOp(left, operator, right):
                mark = OPERATORS[type(operator)]
                return f"({self.expression(left, whole)} {mark} {self.expression(right, whole)})"
            case ast.BoolOp(operator, values):
                return "(" + f" {OPERATORS[type(operator)]} ".join(map(self.expression, values)) + ")"
            case ast.Compare(left, [ast.In()], [ast.Tuple(values)]):
                one = self.expression(left)
                return "(" + " || ".join(f"{one} == {self.expression(value)}" for value in values) + ")"
            case ast.Compare(left, operators, rights):
                sides = [self.expression(side) for side in (left, *rights)]
                pairs = [
                    f"{sides[i]} {OPERATORS[type(operator)]} {sides[i + 1]}" for i, operator in enumerate(operators)
                ]
                return "(" + " && ".join(pairs) + ")"
            case ast.IfExp(test, body, otherwise):
                sides = [self.expression(side, whole) for side in (body, otherwise)]
                return f"({self.expression(test)} ? {sides[0]} : {sides[1]})"
            case ast.Call() as call:
                return self.call(call)
        raise NotImplementedError(f"{self.function.name}: {ast.unparse(node)}")

    def call(self, node: ast.Call, extra: str = "") -> str:
        if isinstance(node.func, ast.Attribute):
            name, kinds = node.func.attr, []
        else:
            assert isinstance(node.func, ast.Name)
            name = self.function.calls.get(node.func.id, BUILTINS.get(node.func.id, node.func.id))
            kinds = self.kinds.get(name, [])
        given = [
            self.expression(one, index < len(kinds) and kinds[index] == WHOLE) for index, one in enumerate(node.args)
        ]
        return f"{name}({', '.join([*given, *([extra] if extra else [])])})"
