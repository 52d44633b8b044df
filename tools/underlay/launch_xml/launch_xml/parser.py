# SPDX-License-Identifier: Apache-2.0
"""The parser of launch files in XML."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from launch.failures import CallSite, note_line
from launch.frontend.parser import Parser as BaseParser
from launch.invalid_launch_file_error import InvalidFrontendLaunchFileError

if TYPE_CHECKING:
    from launch.frontend.parser import SomeFile
    from launch_xml.entity import Entity


class Parser(BaseParser):
    """Reads launch files in XML."""

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
            The file is not XML.

        """
        from launch_xml.entity import Entity, NotXMLError, read_tree

        name, content = _read(file)
        try:
            return Entity(read_tree(content), file_name=name), cls()
        except NotXMLError as error:
            failure = InvalidFrontendLaunchFileError(f'the file is not XML: {error}')
            note_line(failure, CallSite(name, error.line))
            raise failure from error

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the ends of the names of files in XML."""
        return {'launch.xml', 'xml', 'launch'}


def _read(file: SomeFile) -> tuple[str, str | bytes]:
    """Return the name and the content of a file, which may be open already."""
    if isinstance(file, (str, os.PathLike)):
        with open(file, 'rb') as opened:
            return os.fspath(file), opened.read()
    return getattr(file, 'name', '<string>'), file.read()
