# SPDX-License-Identifier: Apache-2.0
"""Find launch files, show their arguments, and run them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from ros2launch.api.arguments import (
        get_share_file_path_from_package,
        MultipleLaunchFilesError,
        parse_launch_arguments,
    )
    from ros2launch.api.running import (
        launch_a_launch_file,
        print_a_launch_file,
        print_arguments_of_launch_file,
    )

__all__ = [
    'MultipleLaunchFilesError',
    'get_share_file_path_from_package',
    'launch_a_launch_file',
    'parse_launch_arguments',
    'print_a_launch_file',
    'print_arguments_of_launch_file',
]

__getattr__, __dir__ = lazy_exports(
    __name__,
    __all__,
    {
        'MultipleLaunchFilesError': 'arguments',
        'get_share_file_path_from_package': 'arguments',
        'launch_a_launch_file': 'running',
        'parse_launch_arguments': 'arguments',
        'print_a_launch_file': 'running',
        'print_arguments_of_launch_file': 'running',
    },
)
