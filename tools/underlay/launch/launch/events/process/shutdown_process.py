# SPDX-License-Identifier: Apache-2.0
"""The event that ends certain processes."""

from __future__ import annotations

from launch.events.process.process_targeted_event import ProcessTargetedEvent


class ShutdownProcess(ProcessTargetedEvent):
    """The processes that a matcher accepts are to end."""

    name = 'launch.events.process.ShutdownProcess'
