# SPDX-License-Identifier: Apache-2.0
"""Launch files in formats other than Python, and the source that loads one."""

from __future__ import annotations

import os

from launch.frontend.parser import Parser
from launch.launch_description import LaunchDescription
from launch.launch_description_source import LaunchDescriptionSource
from launch.substitution import SomeSubstitutionsType


class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    """
    Source that loads a launch file in XML, YAML or another format that a parser is installed for.

    Parameters
    ----------
    launch_file_path
        The path of the file, as a string or substitutions.
    method
        A human-readable name of the loading method.
    parser
        The parser of the format; by default any that can read the file.

    """

    _loads_file = True

    def __init__(
        self,
        launch_file_path: SomeSubstitutionsType,
        *,
        method: str = 'interpreted frontend launch file',
        parser: type[Parser] = Parser,
    ) -> None:
        super().__init__(None, launch_file_path, method)
        self.__parser = parser

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_frontend_launch_file(location, parser=self.__parser)


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
