# SPDX-License-Identifier: Apache-2.0
"""Parse strings with substitutions, such as `$(find-pkg-share $(var package))/launch`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import re
from typing import Any, Union

from launch.frontend.expose import instantiate_substitution
from launch.substitution import Substitution, TextSubstitution

_NAME = re.compile(r'[A-Za-z][A-Za-z0-9_-]*')
_HARMLESS = re.compile(r'[A-Za-z0-9_/.:,#=-]+')
_OPENING = '$('
_QUOTES = '\'"'


def parse_substitution(string_value: str) -> list[Substitution]:
    """
    Parse a string of a launch file with substitutions such as `$(name arguments)`.

    Parameters
    ----------
    string_value
        The text.

    Returns
    -------
    list of Substitution
        Its parts in order, a `TextSubstitution` for each plain string.

    Raises
    ------
    InvalidSubstitutionError
        A substitution has a syntax error, or is unknown.

    """
    return [part for part, _ in parse_with_positions(string_value)]


def parse_if_substitutions(value: Any) -> Any:
    """
    Parse a string, or each string of a list; return anything else as it is.

    Parameters
    ----------
    value
        The value of an attribute.

    Returns
    -------
    Any
        The substitutions of the string, a list of those of each string, or the value.

    Raises
    ------
    InvalidSubstitutionError
        A substitution has a syntax error, or is unknown.

    """
    if isinstance(value, str):
        return parse_substitution(value)
    if isinstance(value, list) and value and all(isinstance(item, str) for item in value):
        return [parse_substitution(item) for item in value]
    return value


def replace_escaped_characters(data: str) -> str:
    """
    Replace each escape sequence in a string by the escaped character.

    Parameters
    ----------
    data
        The string, in which substitutions are not parsed.

    """
    return re.sub(r'\\(.)', r'\1', data, flags=re.DOTALL)


def parse_with_positions(text: str) -> Iterator[tuple[Substitution, int]]:
    """
    Parse a string of a launch file, with the positions of its substitutions.

    Parameters
    ----------
    text
        The text.

    Yields
    ------
    tuple
        Each part as a substitution, and its start index in the string; 0 for plain strings.

    Raises
    ------
    InvalidSubstitutionError
        A substitution has a syntax error, or is unknown.

    """
    for part in read_template(text):
        position = part.position if isinstance(part, Call) else 0
        yield _make(part, text), position


def _make(part: Union[str, Call], text: str) -> Substitution:
    if isinstance(part, str):
        return TextSubstitution(text=part)
    arguments = [_make_all(argument, text) for argument in part.arguments]
    try:
        return instantiate_substitution(part.name, arguments)
    except (LookupError, TypeError, ValueError) as error:
        problem = str(error.args[0]) if error.args else str(error)
        raise InvalidSubstitutionError(problem, text, part.position) from error


def _make_all(template: Template, text: str) -> list[Substitution]:
    return [_make(part, text) for part in template]


@dataclass(frozen=True)
class Call:
    """A substitution in a string: its name, its arguments and its position."""

    name: str
    arguments: list[Template]
    position: int


Template = list[Union[str, Call]]


def read_template(text: str) -> Template:
    """
    Split a string of a launch file into plain strings and substitutions.

    Parameters
    ----------
    text
        The text; backslashes in it escape the characters after them.

    Returns
    -------
    list
        A `str` for each plain string, and a `Call` for each substitution.

    Raises
    ------
    InvalidSubstitutionError
        A substitution has a syntax error.

    """
    return _Reader(text).template(stop='')


class _Reader:
    """Recursive descent parser of a string."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._open_quotes = ''

    def template(self, stop: str) -> Template:
        """Read up to an unescaped character of `stop`, or to the end."""
        parts: Template = []
        plain = ''
        while self._at < len(self._text) and self._text[self._at] not in stop:
            if self._text.startswith(_OPENING, self._at):
                parts += [plain, self._call()] if plain else [self._call()]
                plain = ''
            else:
                plain += self._plain_text()
        return [*parts, plain] if plain or not parts else parts

    def _plain_text(self) -> str:
        """Read a character, an escaped character, or a run of ordinary characters."""
        harmless = _HARMLESS.match(self._text, self._at)
        if harmless is not None:
            self._at = harmless.end()
            return harmless.group()
        escaped = self._text[self._at] == '\\' and self._at + 1 < len(self._text)
        self._at += 2 if escaped else 1
        return self._text[self._at - 1]

    def _call(self) -> Call:
        position = self._at
        self._at += len(_OPENING)
        match = _NAME.match(self._text, self._at)
        if match is None:
            raise self._error("a substitution begins with its name, such as in '$(var robot)'")
        self._at = match.end()
        arguments = []
        while self._next() == ' ':
            self._at += 1
            arguments.append(self._argument())
        if self._next() != ')':
            raise self._unfinished(match.group(), position)
        self._at += 1
        return Call(match.group(), arguments, position)

    def _argument(self) -> Template:
        quote = self._next()
        if not quote or quote in ' )':
            raise self._error('there is an extra space: exactly one must precede each argument')
        if quote not in _QUOTES:
            return self.template(stop=' \t\r\n()' + _QUOTES)
        self._check_quote(quote)
        return self._quoted(quote)

    def _quoted(self, quote: str) -> Template:
        start = self._at
        outside = self._open_quotes
        self._open_quotes += quote
        self._at += 1
        content = self.template(stop=quote)
        if self._next() != quote:
            self._at = start
            raise self._error(f'the quote {quote} is never closed')
        self._at += 1
        self._open_quotes = outside
        return content

    def _check_quote(self, quote: str) -> None:
        if quote in self._open_quotes:
            raise self._error(
                f'the quote {quote} is already open: use the other kind of quotes inside it'
            )

    def _next(self) -> str:
        return self._text[self._at] if self._at < len(self._text) else ''

    def _unfinished(self, name: str, position: int) -> InvalidSubstitutionError:
        found = self._next()
        if not found:
            self._at = position
            return self._error(f"the substitution '{name}' is never closed: a ')' is missing")
        return self._error(
            f"'{found}' is not allowed there in the substitution '{name}': put the whole argument "
            'in quotes, or a backslash before it'
        )

    def _error(self, problem: str) -> InvalidSubstitutionError:
        return InvalidSubstitutionError(
            f'Syntax error in a substitution: {problem}.', self._text, self._at
        )


class InvalidSubstitutionError(RuntimeError):
    """A string has a substitution that is malformed or unknown."""

    def __init__(self, problem: str, text: str, position: int) -> None:
        """Create the error for a problem at a position in a string."""
        self.text = text
        self.position = position
        self.line = text.count('\n', 0, position) + 1
        super().__init__(f'{problem}\n{self._where()}')

    def _where(self) -> str:
        """Format the line and the column of the problem."""
        lines = self.text.split('\n')
        column = self.position - (self.text.rfind('\n', 0, self.position) + 1) + 1
        return f"It is at character {column} of '{lines[self.line - 1]}'."
