# SPDX-License-Identifier: Apache-2.0
"""A launch file in Python as the source of a launch description."""

from __future__ import annotations

import os

from launch.launch_description import LaunchDescription
from launch.launch_description_source import LaunchDescriptionSource
from launch.launch_description_sources.python_launch_file_utilities import (
    get_launch_description_from_python_launch_file,
)
from launch.some_substitutions_type import SomeSubstitutionsType

_OTHER_FORMATS = {
    '.xml': 'XMLLaunchDescriptionSource',
    '.yaml': 'YAMLLaunchDescriptionSource',
    '.yml': 'YAMLLaunchDescriptionSource',
}
_ADVICE = 'The file is not one in Python: {}, or AnyLaunchDescriptionSource, reads it.'


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """
    Source that loads a launch file in Python.

    Parameters
    ----------
    launch_file_path
        The path of the file, as a string or substitutions.

    """

    _loads_file = True

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, 'interpreted python launch file')

    def _get_launch_description(self, location: str) -> LaunchDescription:
        try:
            return get_launch_description_from_python_launch_file(location)
        except SyntaxError as error:
            other = _OTHER_FORMATS.get(os.path.splitext(location)[1])
            if other is None:
                raise
            raise SyntaxError(f'{error}\n{_ADVICE.format(other)}') from error
