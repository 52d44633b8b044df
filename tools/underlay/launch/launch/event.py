# SPDX-License-Identifier: Apache-2.0
"""The base class of all events."""

from __future__ import annotations

from typing import Any


class Event:
    """Base class of events that occur while a launch runs."""

    name = 'launch.Event'

    def outline(self) -> dict[str, Any]:
        """Return the facts about the event that a dry run shows."""
        return {'event': type(self).__name__}
