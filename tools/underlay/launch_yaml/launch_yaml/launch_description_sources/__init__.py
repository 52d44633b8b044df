# SPDX-License-Identifier: Apache-2.0
"""The source of launch descriptions in YAML."""

from __future__ import annotations

from launch.launch_description_sources.frontend_launch_description_source import (
    FrontendLaunchDescriptionSource,
)
from launch.substitution import SomeSubstitutionsType
from launch_yaml.parser import Parser
from ros_environment.lazy import also_found_at

__all__ = [
    'YAMLLaunchDescriptionSource',
]


class YAMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    """
    Loads a launch file in YAML.

    Parameters
    ----------
    launch_file_path
        The path of the file.

    """

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(launch_file_path, method='interpreted YAML launch file', parser=Parser)


# ROS 2 Jazzy has a module for it; launch files import from that, too.
also_found_at(__name__, 'yaml_launch_description_source')
