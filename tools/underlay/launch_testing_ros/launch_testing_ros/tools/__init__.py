# SPDX-License-Identifier: Apache-2.0
"""Filter the output of ROS nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_testing_ros.tools import output
    from launch_testing_ros.tools.output import basic_output_filter

__all__ = ['basic_output_filter', 'output']

__getattr__, __dir__ = lazy_exports(
    __name__, __all__, {'basic_output_filter': 'output', 'output': ''}
)
