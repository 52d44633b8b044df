# SPDX-License-Identifier: Apache-2.0
"""Parse the elements of a launch file into actions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
import os
from typing import Any, Optional, TextIO, TYPE_CHECKING, Union

from launch.failures import note_line
from launch.frontend.expose import extension_parsers, instantiate_action, load, PARSERS
from launch.frontend.parse_substitution import (
    parse_if_substitutions,
    parse_substitution,
    replace_escaped_characters,
)
from launch.invalid_launch_file_error import InvalidFrontendLaunchFileError
from launch.launch_description import LaunchDescription

if TYPE_CHECKING:
    from launch.action import Action
    from launch.frontend.entity import Entity
    from launch.substitution import Substitution

SomeFile = Union[str, 'os.PathLike[str]', TextIO]


class Parser:
    """Base class of the parsers of launch files; each format overrides `load`."""

    @classmethod
    def load(cls, file: SomeFile) -> tuple[Entity, Parser]:
        """
        Load a launch file; parsers that claim its file name are tried first.

        Parameters
        ----------
        file
            The path of the file, or an open text file, which is read again for each parser.

        Returns
        -------
        tuple
            The root element of the file, and the parser of its format.

        Raises
        ------
        InvalidFrontendLaunchFileError
            No parser can read it; the message has the errors of those that claim its file name.

        """
        errors: dict[type[Parser], InvalidFrontendLaunchFileError] = {}
        name = os.fspath(getattr(file, 'name', '') if hasattr(file, 'read') else file)
        for parser in cls._in_order(name):
            try:
                return parser.load(file)
            except InvalidFrontendLaunchFileError as error:
                errors[parser] = error
                _rewind(file)
        claimed = [failure for parser, failure in errors.items() if parser.claims(name)]
        if len(claimed) == 1:
            raise claimed[0]
        raise InvalidFrontendLaunchFileError('\n'.join(map(str, claimed)))

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the file extensions of this format; each format overrides this."""
        return set()

    @classmethod
    def claims(cls, file_name: str) -> bool:
        """
        Whether the extension of a file name is one of this format.

        Parameters
        ----------
        file_name
            The name or the path of the file.

        """
        return any(file_name.endswith(f'.{end}') for end in cls.get_file_extensions())

    @classmethod
    def get_available_extensions(cls) -> list[str]:
        """Return the file extensions of all available formats."""
        return sorted(end for each in cls._available() for end in each.get_file_extensions())

    @classmethod
    def is_extension_valid(cls, extension: str) -> bool:
        """
        Whether there is a parser for files with an extension.

        Parameters
        ----------
        extension
            The extension, with or without its dot.

        """
        return extension.lstrip('.') in cls.get_available_extensions()

    @classmethod
    def _in_order(cls, file_name: str) -> Iterator[type[Parser]]:
        """Yield the parsers, starting with those that claim the file name."""
        known = list(_known_parsers())
        yield from sorted(known, key=lambda parser: not parser.claims(file_name))
        yield from (parser for parser in cls._available() if parser not in known)

    @classmethod
    def _available(cls) -> Iterable[type[Parser]]:
        return [*_known_parsers(), *extension_parsers().values()]

    def parse_action(self, entity: Entity) -> Action:
        """
        Create the action that an element describes.

        Parameters
        ----------
        entity
            The element, whose line becomes that of the action.

        """
        try:
            action = instantiate_action(entity, self)
        except Exception as error:
            note_line(error, entity.call_site, entity.type_name)
            raise
        if entity.call_site is not None:
            action.call_site = entity.call_site
        return action

    def parse_actions(self, entities: Iterable[Entity]) -> list[Action]:
        """
        Create the actions that elements describe.

        Parameters
        ----------
        entities
            The elements, in order.

        """
        return [self.parse_action(entity) for entity in entities]

    def parse_substitution(self, value: str) -> list[Substitution]:
        """
        Parse a string with substitutions.

        Parameters
        ----------
        value
            The text.

        Returns
        -------
        list of Substitution
            Its parts in order.

        Raises
        ------
        InvalidSubstitutionError
            A substitution has a syntax error, or is unknown.

        """
        return parse_substitution(value)

    def escape_characters(self, value: str) -> str:
        """
        Replace escape sequences in a string that cannot have substitutions.

        Parameters
        ----------
        value
            The text.

        """
        return replace_escaped_characters(value)

    def parse_if_substitutions(self, value: Any) -> Any:
        """
        Parse a string, or each string of a list; return anything else as it is.

        Parameters
        ----------
        value
            The value of an attribute.

        Returns
        -------
        Any
            As for `launch.frontend.parse_substitution.parse_if_substitutions`.

        """
        return parse_if_substitutions(value)

    def parse_description(self, entity: Entity) -> LaunchDescription:
        """
        Create the launch description that the root element describes.

        Parameters
        ----------
        entity
            The root element.

        Raises
        ------
        RuntimeError
            Its tag is not `launch`.

        """
        if entity.type_name != 'launch':
            raise RuntimeError("Expected 'launch' as root tag")
        deprecated: Optional[str] = entity.get_attr('deprecated', optional=True)
        return LaunchDescription(self.parse_actions(entity.children), deprecated_reason=deprecated)


def _known_parsers() -> Iterator[type[Parser]]:
    """Yield the parsers of this workspace that are installed."""
    from importlib.util import find_spec

    for place in PARSERS.values():
        if find_spec(place.partition('.')[0]) is not None:
            yield load(place)


def _rewind(file: SomeFile) -> None:
    seek = getattr(file, 'seek', None)
    if seek is not None:
        seek(0)
