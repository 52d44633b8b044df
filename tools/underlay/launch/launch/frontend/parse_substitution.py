# SPDX-License-Identifier: Apache-2.0
"""Parse strings with substitutions in launch files."""

from __future__ import annotations

from collections.abc import Iterator
import re
from typing import Any, Union

from launch.frontend._grammar import Call, read_template, Template
from launch.frontend.expose import instantiate_substitution
from launch.frontend.invalid_substitution_error import InvalidSubstitutionError
from launch.substitution import Substitution
from launch.substitutions.text_substitution import TextSubstitution


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
