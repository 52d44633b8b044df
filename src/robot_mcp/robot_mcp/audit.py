# SPDX-License-Identifier: Apache-2.0
"""Who asked the robot for what, and what came of it: a JSON object a line, only ever appended."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import datetime, timezone
import json
import os
from pathlib import Path
from typing import Any

__all__ = ['AuditLog', 'default_path']

_LONGEST = 2000


def default_path(environment: Mapping[str, str]) -> Path:
    """
    Locate the log if nobody says otherwise: below ROS_HOME, or ~/.ros.

    Parameters
    ----------
    environment
        The variables of the process, of which ROS_HOME counts.

    """
    home = environment.get('ROS_HOME') or str(Path('~').expanduser() / '.ros')
    return Path(home) / 'robot_mcp' / 'audit.jsonl'


class AuditLog:
    """
    Appends to a file. Whatever happens to that file, no call fails because of it.

    Parameters
    ----------
    path
        The file; its folder is made.
    warn
        Is told once, as a sentence, when something cannot be written, until it can be again.
    now
        Returns the time.

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
        Append a line.

        Parameters
        ----------
        client, tool
            Who called what.
        arguments : Any
            What was sent; the beginning of it, if it is endless.
        outcome
            `begun`, or what came of it.

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
        """Write a line as a whole; mend a torn one before it by a new line."""
        self._path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_NONBLOCK | os.O_NOFOLLOW
        file = os.open(self._path, flags, 0o600)
        try:
            line = b'\n' + line if self._is_torn else line
            written = os.write(file, line)
            self._is_torn = 0 < written < len(line)
            if written < len(line):
                raise OSError('there is no room')
        finally:
            os.close(file)


def _short(arguments: Any) -> Any:
    """Return arguments as they are, or the beginning of their text."""
    try:
        text = json.dumps(arguments)
    except (TypeError, ValueError, RecursionError):
        return f'{type(arguments).__name__} that is no JSON'
    return arguments if len(text) <= _LONGEST else f'{text[:_LONGEST]}...'
