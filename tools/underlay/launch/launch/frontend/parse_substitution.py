# SPDX-License-Identifier: Apache-2.0
"""Make substitutions of the texts in launch files."""

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
    """Return what a text stands for, each `$(name arguments)` in it as a substitution."""
    return [part for part, _ in parse_with_positions(string_value)]


def parse_if_substitutions(value: Any) -> Any:
    """Parse a text, or each text of a list; return anything else as it is."""
    if isinstance(value, str):
        return parse_substitution(value)
    if isinstance(value, list) and value and all(isinstance(item, str) for item in value):
        return [parse_substitution(item) for item in value]
    return value


def replace_escaped_characters(data: str) -> str:
    """Return a text with each backslash replaced by the character that it protects."""
    return re.sub(r'\\(.)', r'\1', data, flags=re.DOTALL)


def parse_with_positions(text: str) -> Iterator[tuple[Substitution, int]]:
    """Yield the parts of a text, each with the position that it begins at, or 0 if plain."""
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
