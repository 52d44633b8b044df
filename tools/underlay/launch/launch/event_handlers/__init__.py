# SPDX-License-Identifier: Apache-2.0
"""The event handlers that a launch description may register."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._lazy import lazy_exports

if TYPE_CHECKING:
    from launch.event_handlers.event_named import event_named
    from launch.event_handlers.on_action_event_base import OnActionEventBase
    from launch.event_handlers.on_execution_complete import OnExecutionComplete
    from launch.event_handlers.on_process_exit import OnProcessExit
    from launch.event_handlers.on_process_io import OnProcessIO
    from launch.event_handlers.on_process_start import OnProcessStart
    from launch.event_handlers.on_shutdown import OnShutdown

__all__ = [
    'OnActionEventBase',
    'OnExecutionComplete',
    'OnProcessExit',
    'OnProcessIO',
    'OnProcessStart',
    'OnShutdown',
    'event_named',
]

_ELSEWHERE = {
    'OnProcessIO': 'on_process_io',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
