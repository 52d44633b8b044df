# SPDX-License-Identifier: Apache-2.0
"""Events of ROS nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_ros.events import lifecycle
    from launch_ros.events.matchers import matches_node_name

__all__ = [
    'lifecycle',
    'matches_node_name',
]

_ELSEWHERE = {
    'lifecycle': '',
    'matches_node_name': 'matchers',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
