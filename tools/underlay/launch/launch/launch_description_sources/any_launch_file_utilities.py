# SPDX-License-Identifier: Apache-2.0
"""Load launch files in any format."""

from __future__ import annotations

import os

from launch.frontend.invalid_frontend_launch_file_error import InvalidFrontendLaunchFileError
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_description import LaunchDescription
from launch.launch_description_sources.python_launch_file_utilities import (
    get_launch_description_from_python_launch_file,
)

_OTHER_FORMATS = ('.xml', '.launch', '.yaml', '.yml')


def get_launch_description_from_any_launch_file(
    launch_file_path: str | os.PathLike[str],
) -> LaunchDescription:
    """Return the launch description of a file, whatever its format."""
    path = os.fspath(launch_file_path)
    if not os.path.isfile(path):
        from launch._missing_file import explain_missing_file

        raise FileNotFoundError(explain_missing_file('launch file', path))
    extension = os.path.splitext(path)[1]
    if extension in _OTHER_FORMATS:
        raise InvalidFrontendLaunchFileError(
            f"The launch file may have a syntax error, or its format is unknown: '{path}' is not "
            'a launch file in Python, the only format that this version reads'
        )
    try:
        return get_launch_description_from_python_launch_file(path)
    except Exception as error:
        raise _both(path, extension, error) from error


def _both(path: str, extension: str, error: Exception) -> InvalidLaunchFileError:
    """Return the error of a file that is neither Python nor anything else."""
    if extension != '.py' and isinstance(error, SyntaxError):
        return InvalidFrontendLaunchFileError()
    errors: list[BaseException] = [error, InvalidFrontendLaunchFileError()]
    return InvalidLaunchFileError(extension, likely_errors=errors)
