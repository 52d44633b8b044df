# SPDX-License-Identifier: Apache-2.0
"""A message that the command line fills."""

from __future__ import annotations

from typing import Any

from ros2cli.messages.field_hint import field_hint
from ros2cli.messages.fill import fill
from ros2cli.messages.lookup import UnknownType
from ros2cli.messages.values import parse_values

FIELD_ERROR = 'Failed to populate field: {}'


class OutgoingMessage:
    """A message from the command line, whose time stamps are set anew each time it is sent."""

    def __init__(self, message: Any, text: str, error_text: str = FIELD_ERROR) -> None:
        """Fill the message from YAML; RuntimeError says what is wrong with the values."""
        self.message = message
        values = parse_values(text)
        try:
            self._stamps = fill(message, values)
        except (AttributeError, AssertionError, TypeError, ValueError, UnknownType) as error:
            lines = [error_text.format(error), field_hint(error)]
            raise RuntimeError('\n'.join(lines).rstrip()) from error

    def stamped(self, now: Any) -> Any:
        """Return the message with the time in all fields that want it."""
        for stamp in self._stamps:
            stamp(now)
        return self.message
