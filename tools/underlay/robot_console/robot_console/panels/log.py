# SPDX-License-Identifier: Apache-2.0
"""Panel with the log messages of nodes, and notifications of errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from itertools import takewhile
import re
import time
from typing import Any, NamedTuple

from rcl_interfaces.msg import Log as LogMessage
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from robot_console.live_panel import LivePanel
from robot_console.namespaces import NAMESPACE
from rviz_common.page.channel import Action, Viewer
from rviz_common.properties import Flag, Topic, Whole

__all__ = ['Interruption', 'Interruptions', 'Log', 'LogBook', 'LogLine']

DEBUG, ERROR, FATAL = 10, 40, 50
LONGEST_LINE = 2000
DIGITS = re.compile(r'\d+')

NOTIFICATION_PERIOD_S = 5.0
LONGEST_NOTIFICATION = 300

ALL_OF_BEFORE = QoSProfile(
    depth=1000,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
SHOWN_S = 10.0


class LogLine(NamedTuple):
    """
    Log line of a node; the level is 10 (debug), 20, 30, 40 or 50 (fatal).

    A `LogBook` counts in `times` how often a line was logged, and identifies it by `number`.
    """

    time_s: float
    level: int
    node: str
    text: str
    where: str = ''
    times: int = 1
    number: int = 0


class LogBook:
    """
    The latest log lines, with counts of all lines.

    A line that a node repeats is kept once, as it was logged last: a node that logs much pushes
    nothing out. Lines are repeated if level and text are the same, whatever digits are in it.

    Parameters
    ----------
    kept
        The number of different lines to keep; the one that was not logged for longest goes first.
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
        self._kept = kept
        self._lines: dict[tuple[str, int, str], tuple[int, LogLine]] = {}
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
            The stored line: the level rounded down to one of the five, a long text truncated, and
            how often it was logged. None if it is from another namespace.

        """
        if not self._is_ours(line.node):
            return None
        self.count += 1
        level, text = _level(line.level), _shortened(line.text)
        key = line.node, level, DIGITS.sub('', text)
        _, former = self._lines.pop(key, (0, None))
        times, number = (former.times + 1, former.number) if former else (1, self.count)
        kept = LogLine(line.time_s, level, line.node, text, line.where, times, number)
        self._lines[key] = self.count, kept
        if len(self._lines) > self._kept:
            del self._lines[next(iter(self._lines))]
        self.counts[level] += 1
        self.nodes.add(line.node)
        return kept

    def since(self, count: int) -> list[LogLine]:
        """
        Return the kept lines that were added or repeated after a count, in order of their times.

        Parameters
        ----------
        count
            A previous value of `count`; 0 for all.

        """
        newest_first = reversed(self._lines.values())
        fresh = [line for _, line in takewhile(lambda each: each[0] > count, newest_first)]
        return fresh[::-1]

    def news(self, count: int) -> dict[str, Any]:
        """
        Return the lines since a count, with the counts by level and the nodes, for the page.

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
    if len(text) <= LONGEST_LINE:
        return text
    return f'{text[:LONGEST_LINE]} ... ({len(text) - LONGEST_LINE} characters more)'


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

    def __init__(self, period_s: float = NOTIFICATION_PERIOD_S, silence_s: float = 60.0) -> None:
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
        is_long = len(first.text) > LONGEST_NOTIFICATION
        text = first.text[:LONGEST_NOTIFICATION] + (' ...' if is_long else '')
        more = f' ({count - 1} more: see Log)' if count > 1 else ''
        return Interruption(f'Error of {first.node}', f'{text}{more}')

    def _forget(self, now_s: float) -> None:
        self._said_s = {
            key: said_s for key, said_s in self._said_s.items() if now_s - said_s < self._silence_s
        }


class Log(LivePanel):
    """What nodes say, by level, node and words; errors pop up, whatever is looked at."""

    CLASS = 'robot_console/Log'
    PAGE = 'log'
    PROPERTIES = (
        NAMESPACE,
        Topic('Topic', '/rosout', 'The topic of the log.', 'rcl_interfaces/msg/Log'),
        Whole('Kept Messages', 500, 'Number of different messages to keep.', 10, 5000),
        Flag('Pop Up Errors', True, 'Whether errors pop up in all browsers.'),
    )

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        return {'topic': self._topic(), 'kept': self.values['Kept Messages']}

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {'all': lambda viewer, message: self.greet(viewer)}

    def begin(self) -> None:
        """Subscribe to the log, also without viewers."""
        self._book = LogBook(self.values['Kept Messages'], self.values['Namespace'])
        self._interruptions = Interruptions()
        self._told = 0
        self._ear = self.context.node.create_subscription(
            LogMessage, self._topic(), self._take, ALL_OF_BEFORE
        )

    def greet(self, viewer: Viewer) -> None:
        """
        Send all stored lines to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        self._tell_all()
        viewer.tell(fresh=True, **self._book.news(0))

    def refresh(self) -> None:
        """Send new lines to the viewers, and show notifications of errors."""
        self._tell_all()
        interruption = self._interruptions.due(time.monotonic())
        if interruption and self.values['Pop Up Errors']:
            for client in self.context.server.get_clients().values():
                client.add_notification(*interruption, auto_close_seconds=SHOWN_S, color='red')

    def end(self) -> None:
        """Destroy the subscription."""
        self.context.node.destroy_subscription(self._ear)

    def _topic(self) -> str:
        return self.full_name(self.values['Topic'])

    def _tell_all(self) -> None:
        if self._told != self._book.count and self.channel.viewers:
            self.channel.tell(**self._book.news(self._told))
        self._told = self._book.count

    def _take(self, message: Any) -> None:
        stamp = message.stamp
        where = f'{message.function}() in {message.file}:{message.line}' if message.file else ''
        line = LogLine(
            stamp.sec + stamp.nanosec / 1e9, message.level, message.name, message.msg, where
        )
        kept = self._book.add(line)
        if kept is not None:
            self._interruptions.add(kept, time.monotonic())
