# SPDX-License-Identifier: Apache-2.0
"""The error for an invalid configuration file."""

from __future__ import annotations

__all__ = ['ConfigError']


class ConfigError(ValueError):
    """
    A file that cannot be read or written, with the place and the reason.

    Parameters
    ----------
    source
        The file, or another source of the text.
    line
        The line of the error, counted from 1; None if it concerns the whole file.
    reason
        What is wrong, as a message for the user.

    """

    def __init__(self, source: str, line: int | None, reason: str) -> None:
        self.source = source
        self.line = line
        self.reason = reason
        place = source if line is None else f'{source}:{line}'
        super().__init__(f'{place}: {reason}')
