# SPDX-License-Identifier: Apache-2.0
"""ROS extensions for launch: nodes, parameters, namespaces and lifecycle transitions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_ros import (
        actions,
        descriptions,
        event_handlers,
        events,
        parameter_descriptions,
        ros_adapters,
        substitutions,
        utilities,
    )

__all__ = [
    'actions',
    'descriptions',
    'event_handlers',
    'events',
    'parameter_descriptions',
    'ros_adapters',
    'substitutions',
    'utilities',
]

_ELSEWHERE = {
    'actions': '',
    'descriptions': '',
    'event_handlers': '',
    'events': '',
    'parameter_descriptions': '',
    'ros_adapters': '',
    'substitutions': '',
    'utilities': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
