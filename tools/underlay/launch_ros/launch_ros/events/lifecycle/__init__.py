# SPDX-License-Identifier: Apache-2.0
"""Events of lifecycle nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_ros.events.lifecycle.change_state import ChangeState
    from launch_ros.events.lifecycle.lifecycle_node_matchers import matches_node_name
    from launch_ros.events.lifecycle.state_transition import StateTransition

__all__ = [
    'ChangeState',
    'StateTransition',
    'matches_node_name',
]

_ELSEWHERE = {
    'matches_node_name': 'lifecycle_node_matchers',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
