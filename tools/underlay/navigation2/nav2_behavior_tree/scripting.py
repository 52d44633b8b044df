# SPDX-License-Identifier: Apache-2.0
"""
The scripting language of BehaviorTree.CPP v4: assignments and expressions on the blackboard.

It is described at https://www.behaviortree.dev/docs/guides/scripting.
"""

from __future__ import annotations

from collections.abc import Callable
import operator
import re
from typing import Any, NamedTuple

from nav2_behavior_tree.blackboard import Blackboard
from nav2_behavior_tree.status import TreeError

__all__ = ['Script']

Evaluate = Callable[[Blackboard], Any]

_TOKEN = re.compile(
    r"""\s*(?:(?P<number>0x[0-9a-fA-F]+|\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)
    |(?P<text>'[^']*')
    |(?P<name>[A-Za-z_@][\w@]*)
    |(?P<sign>:=|\+=|-=|\*=|/=|\.\.|&&|\|\||==|!=|<=|>=|<<|>>|[-+*/%<>=!?:;()&|^~]))""",
    re.VERBOSE,
)
_ASSIGNMENTS = (':=', '=', '+=', '-=', '*=', '/=')
_BINARY: dict[str, tuple[int, Callable[[Any, Any], Any]]] = {
    '<': (6, operator.lt),
    '>': (6, operator.gt),
    '<=': (6, operator.le),
    '>=': (6, operator.ge),
    '==': (5, lambda left, right: _alike(left, right)),
    '!=': (5, lambda left, right: not _alike(left, right)),
    '&': (4, lambda left, right: int(left) & int(right)),
    '^': (4, lambda left, right: int(left) ^ int(right)),
    '|': (4, lambda left, right: int(left) | int(right)),
    '..': (7, lambda left, right: _written(left) + _written(right)),
    '+': (8, lambda left, right: _sum(left, right)),
    '-': (8, operator.sub),
    '*': (9, operator.mul),
    '/': (9, lambda left, right: _quotient(left, right)),
}
_AND, _OR = 3, 2
_UNARY_POWER = 10
NAMES = {'true': True, 'false': False, 'RUNNING': 1, 'SUCCESS': 2, 'FAILURE': 3, 'SKIPPED': 4}
"""Names that are constants and not blackboard entries: booleans and node statuses."""


class _Token(NamedTuple):
    kind: str
    text: str


class Script:
    """
    Parsed script; call it with a blackboard to run it and get the value of its last statement.

    Parameters
    ----------
    source
        The text, with `;` between statements.
    file, line
        Its location, for errors.

    Raises
    ------
    TreeError
        It cannot be parsed.

    """

    def __init__(self, source: str, file: str = '', line: int = 0) -> None:
        self._source, self._file, self._line = source, file, line
        self._tokens = self._read()
        self._at = 0
        self._statements: list[Evaluate] = []
        while self._peek().kind != 'end':
            self._statements.append(self._statement())
            if self._peek().text == ';':
                self._at += 1
            elif self._peek().kind != 'end':
                raise self._error(f"';' or an operator is missing before '{self._peek().text}'")
        if not self._statements:
            raise self._error('it is empty')

    def __call__(self, blackboard: Blackboard) -> Any:
        """Run the script; return the value of the last statement."""
        value = None
        try:
            for statement in self._statements:
                value = statement(blackboard)
        except (TypeError, ValueError, ArithmeticError, KeyError) as error:
            reason = error.args[0] if isinstance(error, KeyError) else str(error)
            raise TreeError(
                f"The script '{self._source}' failed: {reason}.", self._file, self._line
            ) from error
        return value

    def _read(self) -> list[_Token]:
        tokens, at = [], 0
        source = self._source.rstrip()
        while at < len(source):
            match = _TOKEN.match(source, at)
            if match is None:
                raise self._error(f"'{source[at:].strip()[:10]}' is not understood")
            at = match.end()
            kind = match.lastgroup or ''
            tokens.append(_Token(kind, match[kind]))
        return [*tokens, _Token('end', '')]

    def _error(self, reason: str) -> TreeError:
        return TreeError(
            f"The script '{self._source}' cannot be read: {reason}.", self._file, self._line
        )

    def _peek(self) -> _Token:
        return self._tokens[self._at]

    def _take(self) -> _Token:
        token = self._tokens[self._at]
        self._at += 1
        return token

    def _statement(self) -> Evaluate:
        first, second = (
            self._tokens[self._at],
            self._tokens[min(self._at + 1, len(self._tokens) - 1)],
        )
        if first.kind == 'name' and second.text in _ASSIGNMENTS:
            self._at += 2
            return _assignment(first.text, second.text, self._expression())
        return self._expression()

    def _expression(self) -> Evaluate:
        condition = self._binary(0)
        if self._peek().text != '?':
            return condition
        self._at += 1
        yes = self._expression()
        if self._take().text != ':':
            raise self._error("':' is missing after '?'")
        no = self._expression()
        return lambda board: yes(board) if condition(board) else no(board)

    def _binary(self, power: int) -> Evaluate:
        left = self._unary()
        while True:
            sign = self._peek().text
            strength = (
                _AND if sign == '&&' else _OR if sign == '||' else _BINARY.get(sign, (-1, None))[0]
            )
            if strength <= power:
                return left
            self._at += 1
            left = _joined(sign, left, self._binary(strength))

    def _unary(self) -> Evaluate:
        token = self._take()
        if token.kind == 'number':
            value = (
                int(token.text, 0) if re.fullmatch(r'0x\w+|\d+', token.text) else float(token.text)
            )
            return lambda _: value
        if token.kind == 'text':
            return lambda _: token.text[1:-1]
        if token.kind == 'name':
            return _name(token.text)
        if token.text == '(':
            inner = self._expression()
            if self._take().text != ')':
                raise self._error("')' is missing")
            return inner
        if token.text in ('-', '!', '~'):
            operand = self._binary(_UNARY_POWER)
            signs: dict[str, Callable[[Any], Any]] = {
                '-': operator.neg,
                '!': operator.not_,
                '~': operator.invert,
            }
            apply = signs[token.text]
            return lambda board: apply(operand(board))
        raise self._error(f"expected a value instead of '{token.text or 'the end'}'")


def _name(name: str) -> Evaluate:
    if name in NAMES:
        return lambda _: NAMES[name]

    def value(board: Blackboard) -> Any:
        if name not in board:
            raise KeyError(f"nothing has set '{name}' yet")
        found = board.get(name)
        return _number(found) if isinstance(found, str) else found

    return value


def _assignment(name: str, sign: str, value: Evaluate) -> Evaluate:
    old = _name(name)
    changes: dict[str, Callable[[Any, Any], Any]] = {
        '+=': _sum,
        '-=': operator.sub,
        '*=': operator.mul,
        '/=': _quotient,
    }
    change = changes.get(sign)

    def assign(board: Blackboard) -> Any:
        if sign == '=' and name not in board:
            raise KeyError(f"nothing has set '{name}' yet; ':=' makes a new entry")
        new = value(board) if change is None else change(old(board), value(board))
        board.set(name, new)
        return new

    return assign


def _joined(sign: str, left: Evaluate, right: Evaluate) -> Evaluate:
    if sign == '&&':
        return lambda board: bool(left(board)) and bool(right(board))
    if sign == '||':
        return lambda board: bool(left(board)) or bool(right(board))
    apply = _BINARY[sign][1]
    return lambda board: apply(left(board), right(board))


def _number(text: str) -> Any:
    """Convert a text to a number if possible, else return the text."""
    try:
        return float(text) if re.search(r'[.eE]', text) else int(text)
    except ValueError:
        return text


def _alike(left: Any, right: Any) -> bool:
    return bool(left == right)


def _sum(left: Any, right: Any) -> Any:
    if isinstance(left, str) or isinstance(right, str):
        return _written(left) + _written(right)
    return left + right


def _quotient(left: Any, right: Any) -> Any:
    value = left / right
    return (
        int(value)
        if isinstance(left, int) and isinstance(right, int) and value % 1 == 0
        else value
    )


def _written(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
