# SPDX-License-Identifier: Apache-2.0
"""The event that terminates certain processes."""

from __future__ import annotations

from launch.events.process.process_targeted_event import ProcessTargetedEvent


class ShutdownProcess(ProcessTargetedEvent):
    """Event that requests the termination of the processes that a matcher accepts."""

    name = 'launch.events.process.ShutdownProcess'
