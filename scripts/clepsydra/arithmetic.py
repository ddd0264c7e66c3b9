"""Arithmetic that stands in a data file: numbers, names, + - * / **, brackets and a few functions. Nothing else is
run."""

import ast
import math
import operator
from typing import Any, Callable, Mapping

OPERATORS: dict[type, Callable[..., float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
FUNCTIONS: dict[str, Callable[..., float]] = {
    "sqrt": math.sqrt,
    "pow": math.pow,
    "exp": math.exp,
    "log": math.log,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "mag": abs,
    "min": min,
    "max": max,
    "pi": lambda: math.pi,
    "round": lambda value: float(round(value)),
}  # a float: powers of whole numbers may take for ever
MOST_CHARACTERS = 1000


def evaluate(expression: str, names: Mapping[str, Any] = {}) -> float:
    """The value, a finite float. ValueError, in words, where there is none."""
    if len(expression) > MOST_CHARACTERS:
        raise ValueError(f"is longer than {MOST_CHARACTERS} characters")
    try:
        value = value_of(ast.parse(expression.strip(), mode="eval").body, names)
    except (SyntaxError, TypeError, OverflowError, ZeroDivisionError, RecursionError, MemoryError) as problem:
        raise ValueError(f"cannot be computed ({type(problem).__name__})") from None
    if isinstance(value, complex) or not math.isfinite(value):
        raise ValueError("is no finite number")
    return value


def value_of(node: ast.expr, names: Mapping[str, Any]) -> float:
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        return float(node.value)
    if isinstance(node, ast.Name):
        if type(names.get(node.id)) not in (int, float):
            raise ValueError(f"needs '{node.id}', which is no number known here")
        return names[node.id]
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        return OPERATORS[type(node.op)](value_of(node.left, names), value_of(node.right, names))
    if isinstance(node, ast.UnaryOp) and type(node.op) in OPERATORS:
        return OPERATORS[type(node.op)](value_of(node.operand, names))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
        if node.func.id in FUNCTIONS:
            return FUNCTIONS[node.func.id](*(value_of(argument, names) for argument in node.args))
        raise ValueError(f"has a function '{node.func.id}'; allowed: {', '.join(FUNCTIONS)}")
    raise ValueError("is no arithmetic of numbers, names, + - * / ** and brackets")
