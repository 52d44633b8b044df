# SPDX-License-Identifier: Apache-2.0
"""
Message filters: expressions in Python syntax, of which only a safe subset is allowed.

The expression is parsed but never evaluated by Python: each allowed node of its syntax tree
becomes a small function of the names in scope, which are `m`, the message, and the loop
variables of generator expressions.
"""

from __future__ import annotations

import argparse
from array import array
import ast
from collections.abc import Callable, Iterator, Mapping
from numbers import Number
import operator
from typing import Any, cast

Names = Mapping[str, Any]
Part = Callable[[Names], Any]


def _of_numbers(operate: Callable[..., Any]) -> Callable[..., Any]:
    """Restrict an operation to numbers; on strings and lists it could exhaust memory."""

    def operate_on_numbers(*operands: Any) -> Any:
        for operand in operands:
            if not isinstance(operand, Number):
                raise TypeError(f'arithmetic needs numbers, not {operand!r}')
        return operate(*operands)

    return operate_on_numbers


FUNCTIONS: dict[str, Callable[..., Any]] = {
    'abs': abs,
    'all': all,
    'any': any,
    'bool': bool,
    'float': float,
    'int': int,
    'len': len,
    'list': list,
    'max': max,
    'min': min,
    'round': round,
    'set': set,
    'sorted': sorted,
    'str': str,
    'sum': sum,
    'tuple': tuple,
}
METHODS = frozenset(
    'count endswith find index isdigit lower lstrip partition rfind rpartition rsplit rstrip '
    'split splitlines startswith strip upper'.split()
)
"""Of texts and sequences: they need no more memory than these."""
SEQUENCES = str, bytes, list, tuple, array
OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: _of_numbers(operator.add),
    ast.Sub: _of_numbers(operator.sub),
    ast.Mult: _of_numbers(operator.mul),
    ast.Div: _of_numbers(operator.truediv),
    ast.FloorDiv: _of_numbers(operator.floordiv),
    ast.Mod: _of_numbers(operator.mod),
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda item, items: item in items,
    ast.NotIn: lambda item, items: item not in items,
    ast.Not: operator.not_,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}


class MessageFilter:
    """
    A condition on messages, compiled from an expression that the user wrote.

    Call it with a message to find out whether the condition holds.

    Parameters
    ----------
    text
        The expression in Python syntax; the message is `m`.

    Raises
    ------
    ArgumentTypeError
        The text is not an expression, or a part of it is not allowed in a filter.

    """

    def __init__(self, text: str) -> None:
        self._text = text
        try:
            self._condition = _compile(ast.parse(text.strip(), mode='eval').body, {'m'})
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            raise argparse.ArgumentTypeError(f'{text!r} is not an expression: {error}') from error

    def __call__(self, message: Any) -> bool:
        """Evaluate the condition; raise RuntimeError if it does not fit the message."""
        try:
            return bool(self._condition({'m': message}))
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
            raise RuntimeError(f'The filter {self._text!r} cannot be applied: {error}') from error


def _compile(node: ast.AST, known: set[str]) -> Part:
    kind = type(node).__name__
    if kind not in COMPILERS:
        raise argparse.ArgumentTypeError(
            f'{ast.unparse(node)!r} is not allowed in a filter: it may have comparisons, '
            'and/or/not, arithmetic, fields, indices, and calls of ' + ', '.join(FUNCTIONS)
        )
    return COMPILERS[kind](node, known)


def _constant(node: ast.Constant, known: set[str]) -> Part:
    value = node.value
    return lambda names: value


def _name(node: ast.Name, known: set[str]) -> Part:
    name = node.id
    if name not in known:
        raise argparse.ArgumentTypeError(f"{name!r} is unknown in a filter; the message is 'm'")
    return lambda names: names[name]


def _attribute(node: ast.Attribute, known: set[str]) -> Part:
    value, name = _compile(node.value, known), node.attr
    if name.startswith('_'):
        raise argparse.ArgumentTypeError(f'{ast.unparse(node)!r} is not a field of a message')
    return lambda names: _field(value(names), name)


def _field(message: Any, name: str) -> Any:
    """Return a field of a message; raise AttributeError for any other attribute or object."""
    if name not in getattr(message, 'get_fields_and_field_types', dict)():
        raise AttributeError(f'{type(message).__name__!r} object has no field {name!r}')
    return getattr(message, name)


def _subscript(node: ast.Subscript, known: set[str]) -> Part:
    value, index = _compile(node.value, known), _compile(node.slice, known)
    return lambda names: value(names)[index(names)]


def _slice(node: ast.Slice, known: set[str]) -> Part:
    limits = [limit and _compile(limit, known) for limit in (node.lower, node.upper, node.step)]
    return lambda names: slice(*(limit and limit(names) for limit in limits))


def _sequence(node: ast.List | ast.Tuple, known: set[str]) -> Part:
    items = [_compile(item, known) for item in node.elts]
    return lambda names: [item(names) for item in items]


def _unary(node: ast.UnaryOp, known: set[str]) -> Part:
    operate, operand = _operator(node, node.op), _compile(node.operand, known)
    return lambda names: operate(operand(names))


def _binary(node: ast.BinOp, known: set[str]) -> Part:
    operate = _operator(node, node.op)
    left, right = _compile(node.left, known), _compile(node.right, known)
    return lambda names: operate(left(names), right(names))


def _boolean(node: ast.BoolOp, known: set[str]) -> Part:
    parts = [_compile(value, known) for value in node.values]
    combine = all if isinstance(node.op, ast.And) else any
    return lambda names: combine(part(names) for part in parts)


def _compare(node: ast.Compare, known: set[str]) -> Part:
    operators = [_operator(node, each) for each in node.ops]
    parts = [_compile(part, known) for part in (node.left, *node.comparators)]

    def compare(names: Names) -> bool:
        left = parts[0](names)
        for operate, part in zip(operators, parts[1:]):
            right = part(names)
            if not operate(left, right):
                return False
            left = right
        return True

    return compare


def _call(node: ast.Call, known: set[str]) -> Part:
    called = node.func
    name = called.id if isinstance(called, ast.Name) else ''
    method = called.attr if isinstance(called, ast.Attribute) else ''
    if node.keywords or not (name in FUNCTIONS or method in METHODS):
        raise argparse.ArgumentTypeError(
            f'{ast.unparse(node)!r} is not a call that filters support: '
            f'{", ".join(FUNCTIONS)}; of texts and lists: {", ".join(sorted(METHODS))}'
        )
    arguments = [_compile(each, known) for each in node.args]
    if isinstance(called, ast.Attribute):
        owner = _compile(called.value, known)
        return lambda names: _method(owner(names), method)(*(each(names) for each in arguments))
    function = FUNCTIONS[name]
    return lambda names: function(*(each(names) for each in arguments))


def _method(value: Any, name: str) -> Callable[..., Any]:
    """Return a method of a text or a sequence; raise AttributeError for anything else."""
    if not isinstance(value, SEQUENCES):
        raise AttributeError(f'{type(value).__name__!r} object has no method {name!r}')
    return cast(Callable[..., Any], getattr(value, name))


def _list(node: ast.ListComp, known: set[str]) -> Part:
    items = _generator(node, known)
    return lambda names: list(items(names))


def _choice(node: ast.IfExp, known: set[str]) -> Part:
    test, then, other = (_compile(each, known) for each in (node.test, node.body, node.orelse))
    return lambda names: (then if test(names) else other)(names)


def _generator(node: ast.GeneratorExp | ast.ListComp, known: set[str]) -> Part:
    loop = node.generators[0]
    if len(node.generators) > 1 or not isinstance(loop.target, ast.Name) or loop.is_async:
        raise argparse.ArgumentTypeError(
            f'{ast.unparse(node)!r} may have only one loop, over a single variable'
        )
    name, items = loop.target.id, _compile(loop.iter, known)
    element = _compile(node.elt, {*known, name})
    conditions = [_compile(each, {*known, name}) for each in loop.ifs]

    def generate(names: Names) -> Iterator[Any]:
        for item in items(names):
            inner = {**names, name: item}
            if all(condition(inner) for condition in conditions):
                yield element(inner)

    return generate


def _operator(node: ast.AST, kind: ast.AST) -> Callable[..., Any]:
    if type(kind) not in OPERATORS:
        raise argparse.ArgumentTypeError(
            f'{ast.unparse(node)!r} uses an operator that filters do not support'
        )
    return OPERATORS[type(kind)]


COMPILERS: dict[str, Callable[[Any, set[str]], Part]] = {
    'Attribute': _attribute,
    'BinOp': _binary,
    'BoolOp': _boolean,
    'Call': _call,
    'Compare': _compare,
    'Constant': _constant,
    'GeneratorExp': _generator,
    'IfExp': _choice,
    'List': _sequence,
    'ListComp': _list,
    'Name': _name,
    'Slice': _slice,
    'Subscript': _subscript,
    'Tuple': _sequence,
    'UnaryOp': _unary,
}
