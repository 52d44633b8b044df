# SPDX-License-Identifier: Apache-2.0
"""A matcher of events by their name."""

from __future__ import annotations

from collections.abc import Callable

from launch.event import Event


def event_named(name: str) -> Callable[[Event], bool]:
    """Return a matcher of the events with this name, such as `launch.events.Shutdown`."""
    return lambda event: event.name == name
