# SPDX-License-Identifier: Apache-2.0
"""Errors for which it is worth to interrupt somebody."""

from __future__ import annotations

from typing import NamedTuple

from robot_console.log.log_book import ERROR, LogLine

__all__ = ['Interruption', 'Interruptions']

PERIOD_S = 5.0
LONGEST = 300


class Interruption(NamedTuple):
    """What is shown to somebody who looks at something else."""

    title: str
    text: str


class Interruptions:
    """
    Collects errors of the log, and limits how often they pop up.

    Parameters
    ----------
    period_s
        The least time between two interruptions, in s.
    silence_s
        A text of a node is shown again only if it was not logged for so long, in s.

    """

    def __init__(self, period_s: float = PERIOD_S, silence_s: float = 60.0) -> None:
        self._period_s = period_s
        self._silence_s = silence_s
        self._waiting: list[LogLine] = []
        self._next_s = 0.0
        self._said_s: dict[tuple[str, str], float] = {}

    def add(self, line: LogLine, now_s: float) -> None:
        """
        Queue a line of the log if it is an error that is due to be shown.

        Parameters
        ----------
        line
            The line; levels below ERROR are ignored.
        now_s
            The time of `time.monotonic`.

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
        Get the interruption that is to be shown now, which empties the queue.

        Parameters
        ----------
        now_s
            The time of `time.monotonic`.

        Returns
        -------
        Interruption or None
            The first error that waits, and how many others there are; None if none waits, or the
            last interruption was too recent.

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
