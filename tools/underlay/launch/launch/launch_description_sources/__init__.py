# SPDX-License-Identifier: Apache-2.0
"""The sources that a launch description can be loaded from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch.launch_description_sources.any_launch_description_source import (
        AnyLaunchDescriptionSource,
        get_launch_description_from_any_launch_file,
    )
    from launch.launch_description_sources.frontend_launch_description_source import (
        FrontendLaunchDescriptionSource,
    )
    from launch.launch_description_sources.frontend_launch_file_utilities import (
        get_launch_description_from_frontend_launch_file,
    )
    from launch.launch_description_sources.python_launch_description_source import (
        PythonLaunchDescriptionSource,
    )
    from launch.launch_description_sources.python_launch_file_utilities import (
        get_launch_description_from_python_launch_file,
        InvalidPythonLaunchFileError,
        load_python_launch_file_as_module,
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

_ELSEWHERE = {
    'InvalidPythonLaunchFileError': 'python_launch_file_utilities',
    'get_launch_description_from_any_launch_file': 'any_launch_description_source',
    'get_launch_description_from_frontend_launch_file': 'frontend_launch_file_utilities',
    'get_launch_description_from_python_launch_file': 'python_launch_file_utilities',
    'load_python_launch_file_as_module': 'python_launch_file_utilities',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
