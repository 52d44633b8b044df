# SPDX-License-Identifier: Apache-2.0
"""Substitutions for ROS packages and parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_ros.substitutions.executable_in_package import ExecutableInPackage
    from launch_ros.substitutions.find_package import (
        FindPackage,
        FindPackagePrefix,
        FindPackageShare,
    )
    from launch_ros.substitutions.parameter import Parameter

__all__ = [
    'ExecutableInPackage',
    'FindPackage',
    'FindPackagePrefix',
    'FindPackageShare',
    'Parameter',
]

_ELSEWHERE = {
    'FindPackagePrefix': 'find_package',
    'FindPackageShare': 'find_package',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
