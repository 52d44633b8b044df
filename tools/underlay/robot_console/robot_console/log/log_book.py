# SPDX-License-Identifier: Apache-2.0
"""The latest log lines of nodes."""

from __future__ import annotations

from collections import Counter, deque
from itertools import islice
from typing import Any, NamedTuple

__all__ = ['ERROR', 'LogBook', 'LogLine']

DEBUG, ERROR, FATAL = 10, 40, 50
LONGEST = 2000


class LogLine(NamedTuple):
    """Log line of a node; the level is 10 (debug), 20, 30, 40 or 50 (fatal)."""

    time_s: float
    level: int
    node: str
    text: str
    where: str = ''


class LogBook:
    """
    The latest log lines, with counts of all lines.

    Parameters
    ----------
    kept
        The number of lines to keep.
    namespace
        Lines of nodes outside this namespace are ignored; '' for all nodes.

    Attributes
    ----------
    count
        The total number of added lines.
    counts
        The number of added lines by level.
    nodes
        The names of the loggers seen so far.

    """

    def __init__(self, kept: int = 500, namespace: str = '') -> None:
        self._lines: deque[LogLine] = deque(maxlen=kept)
        self._namespace = namespace.strip('/').replace('/', '.')
        self.count = 0
        self.counts: Counter[int] = Counter()
        self.nodes: set[str] = set()

    def add(self, line: LogLine) -> LogLine | None:
        """
        Add a line to the log.

        Parameters
        ----------
        line
            The line, with the logger name, such as `robot1.camera`, as its node.

        Returns
        -------
        LogLine or None
            The stored line: the level rounded down to one of the five, a long text truncated. None
            if it is from another namespace.

        """
        if not self._is_ours(line.node):
            return None
        kept = line._replace(level=_level(line.level), text=_shortened(line.text))
        self._lines.append(kept)
        self.count += 1
        self.counts[kept.level] += 1
        self.nodes.add(kept.node)
        return kept

    def since(self, count: int) -> list[LogLine]:
        """
        Return the lines added after a count that are still kept.

        Parameters
        ----------
        count
            A previous value of `count`; 0 for all.

        """
        fresh = min(self.count - count, len(self._lines))
        return list(islice(self._lines, len(self._lines) - fresh, None))

    def news(self, count: int) -> dict[str, Any]:
        """
        Return the lines added after a count, with the counts by level and the nodes, for the page.

        Parameters
        ----------
        count
            As for `since`.

        """
        return {
            'lines': self.since(count),
            'counts': dict(self.counts),
            'nodes': sorted(self.nodes),
        }

    def _is_ours(self, node: str) -> bool:
        space = self._namespace
        return not space or node == space or node.startswith(f'{space}.')


def _level(level: int) -> int:
    """Round a level down to one of the five levels."""
    return min(max(level // 10 * 10, DEBUG), FATAL)


def _shortened(text: str) -> str:
    if len(text) <= LONGEST:
        return text
    return f'{text[:LONGEST]} ... ({len(text) - LONGEST} letters more)'
