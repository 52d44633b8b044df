# SPDX-License-Identifier: Apache-2.0
"""Load launch files in formats other than Python."""

from __future__ import annotations

import os

from launch.frontend.parser import Parser
from launch.launch_description import LaunchDescription


def get_launch_description_from_frontend_launch_file(
    frontend_launch_file_path: str | os.PathLike[str],
    *,
    parser: type[Parser] = Parser,
) -> LaunchDescription:
    """
    Load the launch description of a file in XML, YAML or another format except Python.

    Parameters
    ----------
    frontend_launch_file_path
        The path of the file.
    parser
        The parser of the format; by default any that can read the file.

    Raises
    ------
    FileNotFoundError
        The file does not exist.
    InvalidFrontendLaunchFileError
        The parser cannot read it.

    """
    path = os.fspath(frontend_launch_file_path)
    if not os.path.isfile(path):
        from ros_environment.missing_file import explain_missing_file

        raise FileNotFoundError(explain_missing_file('launch file', path))
    root, reader = parser.load(path)
    return reader.parse_description(root)
