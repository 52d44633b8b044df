# SPDX-License-Identifier: Apache-2.0
"""
The values of a message on the command line, in YAML.

Nearly all are like `{linear: {x: 0.3}, name: arm}`: words, numbers and booleans in braces and
brackets. These are parsed here, since the import of PyYAML takes a tenth of the time of a command;
all other YAML is left to PyYAML, which is only imported for it.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
import re
import sys
from typing import Any

_TOKEN = re.compile(r' *(?:([]{},[])|([a-z][a-z0-9_]*):(?= )|([A-Za-z0-9_.+-]+))', re.ASCII)
_INTEGER = re.compile(r'[+-]?(?:0|[1-9][0-9]{0,17})', re.ASCII)
_DECIMAL = re.compile(r'[+-]?[0-9]{1,17}\.[0-9]{1,17}', re.ASCII)
_WORD = re.compile(r'[A-Za-z][A-Za-z0-9_]*', re.ASCII)
_TRUTH = {'true': True, 'True': True, 'false': False, 'False': False}
_NO_WORDS = ('true', 'false', 'yes', 'no', 'on', 'off', 'null')
_DEEPEST = 20


def parse_values(text: str) -> dict[str, Any]:
    """
    Parse the values of a message's fields.

    Parameters
    ----------
    text
        YAML, such as `{linear: {x: 0.3}}`.

    Returns
    -------
    dict
        The values by field name; empty for an empty text.

    Raises
    ------
    RuntimeError
        The text is not YAML, or not a mapping.

    """
    try:
        return _Simple(text).mapping()
    except _NotSimple:
        return _parse_yaml(text)


def _parse_yaml(text: str) -> dict[str, Any]:
    import yaml

    try:
        values = yaml.safe_load(text)
    except (yaml.YAMLError, LookupError, TypeError, ValueError) as error:  # of values as !!int ''
        raise RuntimeError(f'The passed value is not valid YAML: {error}') from error
    if values is None:
        return {}
    if not isinstance(values, dict):
        raise RuntimeError('The passed value needs to be a dictionary in YAML format')
    return values


class _NotSimple(Exception):
    """The text needs a full YAML parser, or is malformed."""


class _Simple:
    """Parser of simple mappings; its results equal those of PyYAML."""

    def __init__(self, text: str) -> None:
        """Start at the beginning of a text."""
        self._tokens = self._split(text.strip(' '))
        self._depth = 0

    def mapping(self) -> dict[str, Any]:
        """Parse the whole text as a mapping."""
        if self._next()[0] != '{':
            raise _NotSimple
        result = self._rest_of_mapping()
        if next(self._tokens, None) is not None:
            raise _NotSimple
        return result

    def _split(self, text: str) -> Iterator[tuple[str, str, str]]:
        """Tokenize into brackets, commas, names before a colon, and values."""
        place = 0
        while place < len(text):
            found = _TOKEN.match(text, place)
            if found is None:
                raise _NotSimple
            place = found.end()
            yield found[1] or '', found[2] or '', found[3] or ''

    def _next(self) -> tuple[str, str, str]:
        token = next(self._tokens, None)
        if token is None:
            raise _NotSimple
        return token

    def _rest_of_mapping(self) -> dict[str, Any]:
        """Parse `a: 1, b: 2}`, after the opening brace."""
        result: dict[str, Any] = {}
        mark, name, _ = self._next()
        if mark == '}':
            return result
        while name and name not in result and name not in _NO_WORDS:
            result[name] = self._value(self._next())
            if not self._goes_on('}'):
                return result
            name = self._next()[1]
        raise _NotSimple

    def _rest_of_sequence(self) -> list[Any]:
        """Parse `1, 2]`, after the opening bracket."""
        result: list[Any] = []
        token = self._next()
        if token[0] == ']':
            return result
        while True:
            result.append(self._value(token))
            if not self._goes_on(']'):
                return result
            token = self._next()

    def _goes_on(self, end: str) -> bool:
        """Consume a separator; whether it is a comma, and not the closing bracket."""
        mark = self._next()[0]
        if mark not in (',', end):
            raise _NotSimple
        return mark == ','

    def _value(self, token: tuple[str, str, str]) -> Any:
        mark, _, text = token
        if text:
            return _scalar(text)
        self._depth += 1
        if self._depth > _DEEPEST or mark not in ('{', '['):
            raise _NotSimple
        value = self._rest_of_mapping() if mark == '{' else self._rest_of_sequence()
        self._depth -= 1
        return value


def _scalar(text: str) -> Any:
    if _INTEGER.fullmatch(text):
        return int(text)
    if _DECIMAL.fullmatch(text):
        return float(text)
    if text in _TRUTH:
        return _TRUTH[text]
    if _WORD.fullmatch(text) and text.lower() not in _NO_WORDS:
        return text
    raise _NotSimple


def add_values_arguments(parser: argparse.ArgumentParser, what: str) -> None:
    """
    Add the argument for values in YAML, and the option to read them from standard input.

    Parameters
    ----------
    parser
        The parser of the verb.
    what
        The name of the message in the help, such as `goal`.

    """
    source = parser.add_mutually_exclusive_group()
    source.add_argument(
        'values',
        nargs='?',
        default='{}',
        help=f'Values to fill the {what} with in YAML format, otherwise it has default values',
    )
    source.add_argument('--stdin', action='store_true', help='Read values from standard input')


def values_text(args: argparse.Namespace) -> str:
    """
    Return the values in YAML, from the command line or standard input.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_values_arguments`.

    Raises
    ------
    RuntimeError
        Standard input is closed, or is not text.

    """
    text: str = _read_stdin() if args.stdin else args.values
    return text


def _read_stdin() -> str:
    if sys.stdin is None:
        raise RuntimeError('--stdin reads values from standard input, which is closed')
    try:
        return sys.stdin.read()
    except UnicodeDecodeError as error:
        raise RuntimeError(
            f'--stdin reads text, but standard input is not text: {error}'
        ) from error
