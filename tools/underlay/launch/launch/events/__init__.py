# SPDX-License-Identifier: Apache-2.0
"""The events that handlers react to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._lazy import lazy_exports

if TYPE_CHECKING:
    from launch.events import process
    from launch.events.execution_complete import ExecutionComplete
    from launch.events.include_launch_description import IncludeLaunchDescription
    from launch.events.matchers import matches_action
    from launch.events.shutdown import Shutdown
    from launch.events.timer_event import TimerEvent

__all__ = [
    'ExecutionComplete',
    'IncludeLaunchDescription',
    'Shutdown',
    'TimerEvent',
    'matches_action',
    'process',
]

_ELSEWHERE = {
    'matches_action': 'matchers',
    'process': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
