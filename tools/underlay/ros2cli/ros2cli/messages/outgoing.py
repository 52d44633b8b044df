# SPDX-License-Identifier: Apache-2.0
"""Messages filled from the command line."""

from __future__ import annotations

from typing import Any

from ros2cli.messages.field_hint import field_hint
from ros2cli.messages.fill import fill
from ros2cli.messages.lookup import UnknownType
from ros2cli.messages.values import parse_values

FIELD_ERROR = 'Failed to populate field: {}'


class OutgoingMessage:
    """
    Message from the command line whose time stamps are set each time it is sent.

    Parameters
    ----------
    message
        The message, with default values; also an attribute.
    text
        The values of its fields in YAML.
    error_text
        The error message for values that do not fit, with a placeholder for the reason.

    Raises
    ------
    RuntimeError
        The text is not a YAML mapping, or its values do not fit the message.

    """

    def __init__(self, message: Any, text: str, error_text: str = FIELD_ERROR) -> None:
        self.message = message
        values = parse_values(text)
        try:
            self._stamps = fill(message, values)
        except (AttributeError, AssertionError, TypeError, ValueError, UnknownType) as error:
            lines = [error_text.format(error), field_hint(error)]
            raise RuntimeError('\n'.join(lines).rstrip()) from error

    def stamped(self, now: Any) -> Any:
        """
        Set the time stamps, and return the message.

        Parameters
        ----------
        now
            The time, a builtin_interfaces/msg/Time.

        """
        for stamp in self._stamps:
            stamp(now)
        return self.message
