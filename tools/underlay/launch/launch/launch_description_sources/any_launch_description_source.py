# SPDX-License-Identifier: Apache-2.0
"""A launch file in any format as the source of a launch description."""

from __future__ import annotations

import os

from launch.invalid_launch_file_error import InvalidFrontendLaunchFileError, InvalidLaunchFileError
from launch.launch_description import LaunchDescription
from launch.launch_description_source import LaunchDescriptionSource
from launch.launch_description_sources.python_launch_description_source import (
    get_launch_description_from_python_launch_file,
)
from launch.some_substitutions_type import SomeSubstitutionsType

_PYTHON = '.py'


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    """
    Source that loads a launch file in any format.

    Parameters
    ----------
    launch_file_path
        The path of the file, as a string or substitutions.

    """

    _loads_file = True

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, 'any launch file')

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_any_launch_file(location)


def get_launch_description_from_any_launch_file(
    launch_file_path: str | os.PathLike[str],
) -> LaunchDescription:
    """
    Load the launch description of a file, whatever its format.

    Parameters
    ----------
    launch_file_path
        The path of the file, whose extension determines the format that is tried first.

    Raises
    ------
    FileNotFoundError
        The file does not exist.
    InvalidLaunchFileError
        It could not be loaded in any format; the message states why.

    """
    path = os.fspath(launch_file_path)
    if not os.path.isfile(path):
        from ros_environment.missing_file import explain_missing_file

        raise FileNotFoundError(explain_missing_file('launch file', path))
    extension = os.path.splitext(path)[1]
    try:
        return _load_first(path, extension)
    except Exception as error:
        first = error
    try:
        return _load_second(path, extension)
    except Exception as error:
        raise _both(extension, first, error) from first


def _load_first(path: str, extension: str) -> LaunchDescription:
    """Load a file in the format of its extension."""
    if extension == _PYTHON:
        return get_launch_description_from_python_launch_file(path)
    return _load_other_format(path)


def _load_second(path: str, extension: str) -> LaunchDescription:
    """Load a file in the other format; files with the extension `.py` must be Python."""
    if extension == _PYTHON:
        raise InvalidFrontendLaunchFileError()
    return get_launch_description_from_python_launch_file(path)


def _load_other_format(path: str) -> LaunchDescription:
    from launch.frontend.parser import Parser

    root, parser = Parser.load(path)
    return parser.parse_description(root)


def _both(extension: str, first: Exception, second: Exception) -> InvalidLaunchFileError:
    """Create the error for a file that could not be loaded in either format."""
    unknown = isinstance(first, InvalidFrontendLaunchFileError) and not first.is_about_content
    if unknown and isinstance(second, SyntaxError):
        return InvalidFrontendLaunchFileError()
    return InvalidLaunchFileError(extension, likely_errors=[first, second])
