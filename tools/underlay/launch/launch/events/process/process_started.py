# SPDX-License-Identifier: Apache-2.0
"""The event of a process that was started."""

from __future__ import annotations

from launch.events.process.running_process_event import RunningProcessEvent


class ProcessStarted(RunningProcessEvent):
    """Event of a process that was started."""

    name = 'launch.events.process.ProcessStarted'
