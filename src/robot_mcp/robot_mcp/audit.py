# SPDX-License-Identifier: Apache-2.0
"""Append-only audit log of who asked the robot for what, and the outcome, in JSON Lines."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import datetime, timezone
import json
import os
from pathlib import Path
from typing import Any

from humanoid_common.paths import expanded_path

__all__ = ['AuditLog', 'default_path']

_LONGEST = 2000


def default_path(environment: Mapping[str, str]) -> Path:
    """
    Locate the default audit log: below ROS_HOME, or ~/.ros.

    Parameters
    ----------
    environment
        The environment variables, of which ROS_HOME is used.

    Raises
    ------
    UserError
        It is not set, and the user has no home folder.

    """
    home = environment.get('ROS_HOME') or expanded_path('~/.ros')
    return Path(home) / 'robot_mcp' / 'audit.jsonl'


class AuditLog:
    """
    Append-only log file. A failure to write to it never makes a call fail.

    Parameters
    ----------
    path
        The file; its folder is created.
    warn
        Called with a message when writing fails, only once until it succeeds again.
    now
        Returns the current time.

    """

    def __init__(
        self,
        path: Path,
        warn: Callable[[str], object],
        now: Callable[[], datetime] = lambda: datetime.now(timezone.utc),
    ) -> None:
        self._path, self._warn, self._now = path, warn, now
        self._is_broken = self._is_torn = False

    def write(self, client: str, tool: str, arguments: Any, outcome: str) -> None:
        """
        Append a record.

        Parameters
        ----------
        client, tool
            The names of the client, and of the tool that it called.
        arguments : Any
            The arguments as sent; truncated if they are too long.
        outcome
            `begun`, or the outcome of the call.

        """
        line = json.dumps(
            {
                'time': self._now().isoformat(timespec='milliseconds'),
                'client': client[:200],
                'tool': tool[:200],
                'arguments': _short(arguments),
                'outcome': outcome[:_LONGEST],
            }
        )
        try:
            self._append(f'{line}\n'.encode())
        except OSError as error:
            if not self._is_broken:
                self._warn(f"Calls are not logged, as '{self._path}' cannot be written: {error}.")
            self._is_broken = True
        else:
            self._is_broken = False

    def _append(self, line: bytes) -> None:
        """Write a line as a whole; terminate a torn line before it with a newline."""
        self._path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_NONBLOCK | os.O_NOFOLLOW
        file = os.open(self._path, flags, 0o600)
        try:
            line = b'\n' + line if self._is_torn else line
            written = os.write(file, line)
            self._is_torn = 0 < written < len(line)
            if written < len(line):
                raise OSError('no space left')
        finally:
            os.close(file)


def _short(arguments: Any) -> Any:
    """Return arguments unchanged, or as truncated text if they are too long."""
    try:
        text = json.dumps(arguments)
    except (TypeError, ValueError, RecursionError):
        return f'{type(arguments).__name__} that is not valid JSON'
    return arguments if len(text) <= _LONGEST else f'{text[:_LONGEST]}...'
