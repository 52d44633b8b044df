# SPDX-License-Identifier: Apache-2.0
"""Event handlers for ROS nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_ros.event_handlers.on_state_transition import OnStateTransition

__all__ = [
    'OnStateTransition',
]

__getattr__, __dir__ = lazy_exports(__name__, __all__)
