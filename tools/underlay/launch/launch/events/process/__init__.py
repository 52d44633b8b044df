# SPDX-License-Identifier: Apache-2.0
"""The events of processes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..._lazy import lazy_exports

if TYPE_CHECKING:
    from .process_exited import ProcessExited
    from .process_io import ProcessIO
    from .process_matchers import matches_executable
    from .process_matchers import matches_name
    from .process_matchers import matches_pid
    from .process_started import ProcessStarted
    from .process_stderr import ProcessStderr
    from .process_stdin import ProcessStdin
    from .process_stdout import ProcessStdout
    from .process_targeted_event import ProcessTargetedEvent
    from .running_process_event import RunningProcessEvent
    from .shutdown_process import ShutdownProcess
    from .signal_process import SignalProcess

__all__ = [
    'ProcessExited',
    'ProcessIO',
    'ProcessStarted',
    'ProcessStderr',
    'ProcessStdin',
    'ProcessStdout',
    'ProcessTargetedEvent',
    'RunningProcessEvent',
    'ShutdownProcess',
    'SignalProcess',
    'matches_executable',
    'matches_name',
    'matches_pid',
]

_ELSEWHERE = {
    'ProcessIO': 'process_io',
    'matches_executable': 'process_matchers',
    'matches_name': 'process_matchers',
    'matches_pid': 'process_matchers',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
