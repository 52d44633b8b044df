# SPDX-License-Identifier: Apache-2.0
"""Notifications of errors in the log."""

from __future__ import annotations

from typing import NamedTuple

from robot_console.log.log_book import ERROR, LogLine

__all__ = ['Interruption', 'Interruptions']

PERIOD_S = 5.0
LONGEST = 300


class Interruption(NamedTuple):
    """Notification shown to users of other tabs."""

    title: str
    text: str


class Interruptions:
    """
    Collects errors of the log, and limits the rate of their notifications.

    Parameters
    ----------
    period_s
        The minimum time between two notifications, in s.
    silence_s
        The time since a text was last logged by a node after which it is shown again, in s.

    """

    def __init__(self, period_s: float = PERIOD_S, silence_s: float = 60.0) -> None:
        self._period_s = period_s
        self._silence_s = silence_s
        self._waiting: list[LogLine] = []
        self._next_s = 0.0
        self._said_s: dict[tuple[str, str], float] = {}

    def add(self, line: LogLine, now_s: float) -> None:
        """
        Queue a log line if it is an error that should be shown.

        Parameters
        ----------
        line
            The line; levels below ERROR are ignored.
        now_s
            The current time, from `time.monotonic`.

        """
        if line.level < ERROR:
            return
        key = (line.node, line.text)
        last_s = self._said_s.get(key)
        self._said_s[key] = now_s
        if last_s is None or now_s - last_s > self._silence_s:
            self._waiting.append(line)

    def due(self, now_s: float) -> Interruption | None:
        """
        Return the notification to show now, and empty the queue.

        Parameters
        ----------
        now_s
            The current time, from `time.monotonic`.

        Returns
        -------
        Interruption or None
            The first queued error with the number of the others; None if the queue is empty or the
            last notification was too recent.

        """
        if not self._waiting or now_s < self._next_s:
            return None
        first, count = self._waiting[0], len(self._waiting)
        self._waiting.clear()
        self._next_s = now_s + self._period_s
        self._forget(now_s)
        text = first.text[:LONGEST] + (' ...' if len(first.text) > LONGEST else '')
        more = f' ({count - 1} more: see Log)' if count > 1 else ''
        return Interruption(f'Error of {first.node}', f'{text}{more}')

    def _forget(self, now_s: float) -> None:
        self._said_s = {
            key: said_s for key, said_s in self._said_s.items() if now_s - said_s < self._silence_s
        }
