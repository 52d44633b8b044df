# SPDX-License-Identifier: Apache-2.0
"""The events that handlers react to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._lazy import lazy_exports

if TYPE_CHECKING:
    from . import process
    from .execution_complete import ExecutionComplete
    from .include_launch_description import IncludeLaunchDescription
    from .matchers import matches_action
    from .shutdown import Shutdown
    from .timer_event import TimerEvent

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
