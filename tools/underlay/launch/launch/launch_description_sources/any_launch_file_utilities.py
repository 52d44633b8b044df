# SPDX-License-Identifier: Apache-2.0
"""The path that ROS 2 Jazzy has for the function that loads launch files in any format."""

from __future__ import annotations

from launch.launch_description_sources.any_launch_description_source import (
    get_launch_description_from_any_launch_file,
)

__all__ = ['get_launch_description_from_any_launch_file']
