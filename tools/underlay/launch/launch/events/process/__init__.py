# SPDX-License-Identifier: Apache-2.0
"""The events of processes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._lazy import lazy_exports

if TYPE_CHECKING:
    from launch.events.process.process_exited import ProcessExited
    from launch.events.process.process_io import ProcessIO
    from launch.events.process.process_matchers import (
        matches_executable,
        matches_name,
        matches_pid,
    )
    from launch.events.process.process_started import ProcessStarted
    from launch.events.process.process_stderr import ProcessStderr
    from launch.events.process.process_stdin import ProcessStdin
    from launch.events.process.process_stdout import ProcessStdout
    from launch.events.process.process_targeted_event import ProcessTargetedEvent
    from launch.events.process.running_process_event import RunningProcessEvent
    from launch.events.process.shutdown_process import ShutdownProcess
    from launch.events.process.signal_process import SignalProcess

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
