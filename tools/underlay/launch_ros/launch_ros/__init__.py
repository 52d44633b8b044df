# SPDX-License-Identifier: Apache-2.0
"""Describe ROS nodes as parts of a launch description."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._lazy import lazy_exports

if TYPE_CHECKING:
    from launch_ros import actions, descriptions, parameter_descriptions, substitutions, utilities

__all__ = [
    'actions',
    'descriptions',
    'parameter_descriptions',
    'substitutions',
    'utilities',
]

_ELSEWHERE = {
    'actions': '',
    'descriptions': '',
    'parameter_descriptions': '',
    'substitutions': '',
    'utilities': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
