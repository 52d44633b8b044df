# SPDX-License-Identifier: Apache-2.0
"""A diagnostic status that tasks fill in."""

from __future__ import annotations

from typing import Any

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

__all__ = ['DiagnosticStatusWrapper', 'level_of']


def level_of(level: bytes | int) -> bytes:
    """
    Return a level in the type that messages store.

    Parameters
    ----------
    level
        Such as `DiagnosticStatus.WARN`, or its number.

    """
    return level if isinstance(level, bytes) else bytes([level])


class DiagnosticStatusWrapper(DiagnosticStatus):
    """A `DiagnosticStatus` with methods that fill it in."""

    def summary(self, *args: Any) -> None:
        """
        Set the level and the message.

        Parameters
        ----------
        *args
            A level and a message, or another status to take both from.

        """
        level, self.message = _level_and_message(args)
        self.level = level_of(level)

    def clearSummary(self) -> None:  # noqa: N802
        """Set the level to OK and the message to nothing."""
        self.summary(DiagnosticStatus.OK, '')

    def mergeSummary(self, *args: Any) -> None:  # noqa: N802
        """
        Merge a level and a message with those of the status.

        The higher level counts, with its message; if neither is OK, both messages are joined.

        Parameters
        ----------
        *args
            A level and a message, or another status to take both from.

        """
        level, message = _level_and_message(args)
        level = level_of(level)
        if level > DiagnosticStatus.OK and self.level > DiagnosticStatus.OK:
            self.message = '; '.join(filter(None, (self.message, message)))
        elif level > self.level:
            self.message = message
        self.level = max(self.level, level)

    def add(self, key: str, value: Any) -> None:
        """
        Add a value to the status.

        Parameters
        ----------
        key
            What it is.
        value
            The value, which is stored as a text.

        """
        self.values.append(KeyValue(key=key, value=str(value)))


def _level_and_message(args: tuple[Any, ...]) -> tuple[bytes | int, str]:
    if len(args) == 1:
        return args[0].level, args[0].message
    level, message = args
    return level, message
