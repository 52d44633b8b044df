# SPDX-License-Identifier: Apache-2.0
"""Read the attributes and the children of elements, and command lines."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, List, Optional, TYPE_CHECKING  # noqa: UP035

from launch.frontend.entity import Entity
from launch.substitution import Substitution, TextSubstitution

if TYPE_CHECKING:
    from launch.frontend.parser import Parser

Text = tuple[Substitution, ...]

_PROTECTED_BY_BACKSLASH = {'': None, "'": '', '"': '"\\'}


def children_named(entity: Entity, *type_names: str) -> list[Entity]:
    """
    Get the children of an element that have any of the given tags.

    Parameters
    ----------
    entity
        The element.
    *type_names
        The tags.

    Returns
    -------
    list of Entity
        The children in the order of the file; there may be none.

    """
    found: list[Entity] = []
    for name in type_names:
        found += entity.get_attr(name, data_type=List[Entity], optional=True) or []  # noqa: UP006
    return sorted(found, key=lambda child: child.order)


def parse_pairs(
    entity: Entity,
    parser: Parser,
    *type_names: str,
    first: str = 'name',
    second: str = 'value',
) -> list[tuple[Text, Text]]:
    """
    Read two attributes of each child of an element that has any of the given tags.

    Parameters
    ----------
    entity
        The element.
    parser
        The parser of the file, which parses substitutions.
    *type_names
        The tags of the children.
    first, second
        The names of the two attributes.

    Returns
    -------
    list of tuple
        The substitutions of both attributes of each child.

    Raises
    ------
    AttributeError
        A child lacks one of the attributes.
    ValueError
        A child has other attributes or children.

    """
    pairs = []
    for child in children_named(entity, *type_names):
        pairs.append(
            (
                tuple(parser.parse_substitution(child.get_attr(first))),
                tuple(parser.parse_substitution(child.get_attr(second))),
            )
        )
        child.assert_entity_completely_parsed()
    return pairs


def parse_texts(entity: Entity, parser: Parser, names: dict[str, str]) -> dict[str, Any]:
    """
    Read optional string attributes of an element.

    Parameters
    ----------
    entity
        The element.
    parser
        The parser of the file, which parses substitutions.
    names
        The keyword of each attribute in the result.

    Returns
    -------
    dict
        The substitutions of each present attribute, by its keyword.

    """
    kwargs: dict[str, Any] = {}
    for name, keyword in names.items():
        text = entity.get_attr(name, optional=True)
        if text is not None:
            kwargs[keyword] = parser.parse_substitution(text)
    return kwargs


def parse_command(text: str, parser: Parser) -> list[Any]:
    """
    Split a command line of a launch file into words.

    Parameters
    ----------
    text
        The command line.
    parser
        The parser of the file, which parses substitutions.

    Returns
    -------
    list of list of Substitution
        The parts of each word.

    Raises
    ------
    ValueError
        A quote is never closed.

    """
    return list(command_words(parser.parse_substitution(text)))


def command_words(parts: Iterable[Substitution]) -> list[list[Substitution]]:
    """
    Split a command line into words, as a shell does.

    Plain strings are split; the results of substitutions are never split.

    Parameters
    ----------
    parts
        The command line as substitutions.

    Returns
    -------
    list of list of Substitution
        The parts of each word.

    Raises
    ------
    ValueError
        A quote is never closed.

    """
    splitter = _Splitter()
    for part in parts:
        if isinstance(part, TextSubstitution):
            splitter.add_text(part.text)
        else:
            splitter.add(part)
    return splitter.finish()


class _Splitter:
    """Splitter that collects the words."""

    def __init__(self) -> None:
        self._words: list[list[Substitution]] = []
        self._word: Optional[list[Substitution]] = None
        self._plain = ''
        self._quote = ''

    def add(self, part: Substitution) -> None:
        """Add a substitution to the current word."""
        self._flush()
        self._begin().append(part)

    def add_text(self, text: str) -> None:
        """Add a string, which may end words and start others."""
        characters = iter(text)
        for character in characters:
            if character == '\\':
                self._escaped(next(characters, ''))
            elif character == self._quote:
                self._quote = ''
            elif not self._quote and character in '\'"':
                self._quote = character
                self._begin()
            elif not self._quote and character.isspace():
                self._end()
            else:
                self._begin()
                self._plain += character

    def _escaped(self, character: str) -> None:
        """Add a character after a backslash, which is kept if it escapes nothing."""
        protected = _PROTECTED_BY_BACKSLASH[self._quote]
        self._begin()
        if protected is None or character in protected:
            self._plain += character
            return
        self._plain += '\\'
        self.add_text(character)

    def finish(self) -> list[list[Substitution]]:
        """Complete the last word and return all words."""
        if self._quote:
            raise ValueError(f'the quote {self._quote} is never closed in a command line')
        self._end()
        return self._words

    def _begin(self) -> list[Substitution]:
        if self._word is None:
            self._word = []
        return self._word

    def _flush(self) -> None:
        if self._plain:
            self._begin().append(TextSubstitution(text=self._plain))
        self._plain = ''

    def _end(self) -> None:
        self._flush()
        if self._word is not None:
            self._words.append(self._word or [TextSubstitution(text='')])
        self._word = None
