"""Functions as plain Python that imports only `math`."""

from __future__ import annotations

import ast

from hysteresis_bench.export.functions import Function


def python_of(function: Function) -> str:
    """The definition, without decorators and types; its constants as numbers."""
    tree = ast.parse(ast.unparse(function.tree)).body[0]
    assert isinstance(tree, ast.FunctionDef)
    tree = _Plain(function).visit(tree)
    tree.name, tree.decorator_list, tree.returns = function.name, [], None
    for one in tree.args.args:
        one.annotation = None
    if ast.get_docstring(tree):
        tree.body = tree.body[1:]
    if function.summary:
        tree.body.insert(0, ast.Expr(ast.Constant(function.summary)))
    return ast.unparse(ast.fix_missing_locations(tree))


POWER = '''def raised_to(base, exponent):
    """base ** exponent, infinite where it is too large for a number, as compiled code has it."""
    try:
        return base ** exponent
    except OverflowError:
        return -math.inf if base < 0.0 and exponent % 2.0 == 1.0 else math.inf'''
"""What stands in the place of the operator, which raises an error there."""


class _Plain(ast.NodeTransformer):
    def __init__(self, function: Function) -> None:
        self.function = function

    def visit_Name(self, node: ast.Name) -> ast.expr:
        if node.id in self.function.calls:
            return ast.Name(self.function.calls[node.id], node.ctx)
        if node.id in self.function.numbers:
            return ast.Constant(self.function.numbers[node.id])
        return node

    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        """What is used of numpy, `math` has too."""
        return ast.Attribute(ast.Name("math", ast.Load()), node.attr, node.ctx)

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        left, right = self.visit(node.left), self.visit(node.right)
        if isinstance(node.op, ast.Pow):
            return ast.Call(ast.Name("raised_to", ast.Load()), [left, right], [])
        return ast.BinOp(left, node.op, right)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.stmt:
        assert node.value is not None
        return ast.Assign([node.target], self.visit(node.value))
