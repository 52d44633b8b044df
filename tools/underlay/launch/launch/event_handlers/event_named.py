# SPDX-License-Identifier: Apache-2.0
"""Matcher of events by name."""

from __future__ import annotations

from collections.abc import Callable

from launch.event import Event


def event_named(name: str) -> Callable[[Event], bool]:
    """
    Create a matcher of events by name.

    Parameters
    ----------
    name
        The name, such as `launch.events.Shutdown`.

    Returns
    -------
    callable
        Predicate that accepts an event, and returns whether it has the name.

    """
    return lambda event: event.name == name
