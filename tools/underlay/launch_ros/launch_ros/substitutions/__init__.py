# SPDX-License-Identifier: Apache-2.0
"""Substitutions for ROS packages and parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch_ros.substitutions.find_package import (
        ExecutableInPackage,
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

# ROS 2 Jazzy has a module for it; launch files import from that, too.
also_found_at(__name__, 'executable_in_package')

_ELSEWHERE = {
    'ExecutableInPackage': 'find_package',
    'FindPackagePrefix': 'find_package',
    'FindPackageShare': 'find_package',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
