# SPDX-License-Identifier: Apache-2.0
"""The sources that a launch description can be loaded from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch.launch_description_sources.frontend_launch_description_source import (
        FrontendLaunchDescriptionSource,
        get_launch_description_from_frontend_launch_file,
    )
    from launch.launch_description_sources.launch_files import (
        AnyLaunchDescriptionSource,
        get_launch_description_from_any_launch_file,
        get_launch_description_from_python_launch_file,
        InvalidPythonLaunchFileError,
        load_python_launch_file_as_module,
        PythonLaunchDescriptionSource,
    )

__all__ = [
    'AnyLaunchDescriptionSource',
    'FrontendLaunchDescriptionSource',
    'InvalidPythonLaunchFileError',
    'PythonLaunchDescriptionSource',
    'get_launch_description_from_any_launch_file',
    'get_launch_description_from_frontend_launch_file',
    'get_launch_description_from_python_launch_file',
    'load_python_launch_file_as_module',
]

# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(
    __name__,
    'any_launch_description_source',
    'any_launch_file_utilities',
    'frontend_launch_file_utilities',
    'python_launch_description_source',
    'python_launch_file_utilities',
)

_ELSEWHERE = {
    'AnyLaunchDescriptionSource': 'launch_files',
    'InvalidPythonLaunchFileError': 'launch_files',
    'PythonLaunchDescriptionSource': 'launch_files',
    'get_launch_description_from_any_launch_file': 'launch_files',
    'get_launch_description_from_frontend_launch_file': 'frontend_launch_description_source',
    'get_launch_description_from_python_launch_file': 'launch_files',
    'load_python_launch_file_as_module': 'launch_files',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
