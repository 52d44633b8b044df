# SPDX-License-Identifier: Apache-2.0
"""The parser of launch files in YAML."""

from __future__ import annotations

import os
from typing import Any, NoReturn, TYPE_CHECKING

from launch.failures import CallSite, note_line
from launch.frontend.parser import Parser as BaseParser
from launch.invalid_launch_file_error import InvalidFrontendLaunchFileError

if TYPE_CHECKING:
    from launch.frontend.parser import SomeFile
    from launch_yaml.entity import Entity


class Parser(BaseParser):
    """Reads launch files in YAML."""

    @classmethod
    def load(cls, file: SomeFile) -> tuple[Entity, Parser]:
        """
        Load the root element of a launch file, and a parser for it.

        Parameters
        ----------
        file
            The path, or an open file.

        Raises
        ------
        InvalidFrontendLaunchFileError
            The file is not YAML, or not a mapping with one key.

        """
        from launch_yaml.entity import Entity, NotYAMLError, read_document

        name, content = _read(file)
        try:
            document = read_document(content)
        except NotYAMLError as error:
            _fail(f'the file is not YAML: {error}', name, error.line)
        if not isinstance(document, dict):
            _fail("the file must have the key 'launch', with a list of actions below it", name, 1)
        if len(document) != 1:
            _fail(f'the file must have only one key, but it has {_listed(document)}', name, 1)
        [(key, content)] = document.items()
        return Entity(content, str(key), file_name=name, line=1), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the ends of the names of files in YAML."""
        return {'launch.yaml', 'launch.yml', 'yaml', 'yml', 'launch'}


def _fail(problem: str, name: str, line: int) -> NoReturn:
    failure = InvalidFrontendLaunchFileError(problem)
    note_line(failure, CallSite(name, line))
    raise failure


def _listed(document: dict[Any, Any]) -> str:
    return ', '.join(f"'{key}'" for key in document) or 'none'


def _read(file: SomeFile) -> tuple[str, Any]:
    """Return the name and the content of a file, which may be open already."""
    if isinstance(file, (str, os.PathLike)):
        with open(file, 'rb') as opened:
            return os.fspath(file), opened.read()
    return getattr(file, 'name', '<string>'), file.read()
