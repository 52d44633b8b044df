# SPDX-License-Identifier: Apache-2.0
"""A matcher of events by their name."""

from __future__ import annotations

from collections.abc import Callable

from launch.event import Event


def event_named(name: str) -> Callable[[Event], bool]:
    """
    Create a matcher of the events that have a name.

    Parameters
    ----------
    name
        The name, such as `launch.events.Shutdown`.

    Returns
    -------
    callable
        Takes an event, and returns whether it has the name.

    """
    return lambda event: event.name == name
