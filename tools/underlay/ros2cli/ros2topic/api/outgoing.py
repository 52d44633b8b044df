# SPDX-License-Identifier: Apache-2.0
"""The message of `ros2 topic pub`."""

from __future__ import annotations

from typing import Any

from ros2cli.messages.fill import fill
from ros2cli.messages.lookup import get_message, UnknownType
import yaml


class OutgoingMessage:
    """A message from the command line, whose time stamps are set anew for each publication."""

    def __init__(self, type_name: str, text: str) -> None:
        """Make the message; RuntimeError says what is wrong with its type or values."""
        try:
            self.message_type = get_message(type_name)
        except UnknownType as error:
            raise RuntimeError(f'The passed message type is invalid\n{error}') from error
        self.message = self.message_type()
        try:
            self._stamps = fill(self.message, parse_values(text))
        except (AttributeError, AssertionError, TypeError, ValueError, UnknownType) as error:
            raise RuntimeError(f'Failed to populate field: {error}') from error

    def stamped(self, now: Any) -> Any:
        """Return the message with the time in all fields that want it."""
        for stamp in self._stamps:
            stamp(now)
        return self.message


def parse_values(text: str) -> dict[str, Any]:
    """Return the mapping that a text in YAML stands for."""
    try:
        values = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise RuntimeError(f'The passed value is no YAML: {error}') from error
    if values is None:
        return {}
    if not isinstance(values, dict):
        raise RuntimeError('The passed value needs to be a dictionary in YAML format')
    return values
