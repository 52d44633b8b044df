# SPDX-License-Identifier: Apache-2.0
"""Which recordings a folder has, and which of their topics would move a robot if played."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fnmatch import fnmatchcase
import os
from typing import NamedTuple

from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.metadata import FILE_NAME
from rviz_common.status import printable

__all__ = ['COMMANDS', 'Bag', 'BagTopic', 'Shelf', 'commands_among']

MOST = 200
NS_PER_S = 1e9

COMMANDS = (
    'cmd_vel* *_command *_commands *command/* command commands emergency_stop '
    'console_heartbeat goal_pose initialpose clicked_point joint_trajectory */joint_trajectory '
    'goal *_goal *_cmd stop_state'
)
"""Name patterns, without namespace, of topics that command robots or report their stop state."""


class BagTopic(NamedTuple):
    """A recorded topic with its message count."""

    name: str
    type_name: str
    message_count: int


@dataclass(frozen=True)
class Bag:
    """Metadata of a recording; `problem` explains why it cannot be played."""

    name: str
    path: str
    duration_s: float = 0.0
    start_s: float = 0.0
    size_bytes: int = 0
    message_count: int = 0
    topics: tuple[BagTopic, ...] = ()
    problem: str = ''


class Shelf:
    """
    Lists the recordings in a folder; unchanged metadata is read only once.

    Parameters
    ----------
    folder
        The path of the folder; it may start with `~`, and need not exist.

    """

    def __init__(self, folder: str) -> None:
        self.folder = os.path.abspath(os.path.expanduser(folder))
        self._read: dict[str, tuple[int, Bag]] = {}
        self.left_out_count = 0
        """The number of older recordings that are not listed."""

    def look(self) -> list[Bag]:
        """List the recordings, newest first; a missing folder has none."""
        found = sorted(self._changes(), reverse=True)
        self.left_out_count = max(0, len(found) - MOST)
        bags = {path: self._bag(path, changed_ns) for changed_ns, path in found[:MOST]}
        self._read = {path: self._read[path] for path in bags}
        return list(bags.values())

    def _changes(self) -> list[tuple[int, str]]:
        """Return the modification time and the path of each recording."""
        try:
            with os.scandir(self.folder) as entries:
                paths = [each.path for each in entries if not each.name.startswith('.')]
        except OSError:
            return []
        found = ((_changed_ns(path), path) for path in paths)
        return [(changed_ns, path) for changed_ns, path in found if changed_ns]

    def _bag(self, path: str, changed_ns: int) -> Bag:
        if path not in self._read or self._read[path][0] != changed_ns:
            self._read[path] = changed_ns, _described(path)
        return self._read[path][1]


def _changed_ns(path: str) -> int:
    """Return the modification time of a recording; 0 if the path is not a recording."""
    try:
        if not os.path.isdir(path):
            return os.stat(path).st_mtime_ns if path.endswith('.mcap') else 0
        with os.scandir(path) as entries:
            parts = [each for each in entries if _is_part(each.name)]
            return max((each.stat().st_mtime_ns for each in parts), default=0)
    except OSError:
        return 0


def _is_part(name: str) -> bool:
    return name == FILE_NAME or name.endswith(('.mcap', '.db3'))


def _described(path: str) -> Bag:
    name = printable(os.path.basename(path))
    try:
        reader = BagReader(path)
        span = reader.metadata.span
        return Bag(
            name,
            path,
            span.duration_ns / NS_PER_S,
            span.start_ns / NS_PER_S,
            reader.size_bytes,
            span.message_count,
            tuple(
                BagTopic(each.topic.name, each.topic.type_name, each.message_count)
                for each in reader.metadata.topics
            ),
            '' if span.message_count else 'It has no messages.',
        )
    except (BagError, OSError) as error:
        return Bag(name, path, problem=str(error))


def commands_among(topics: Iterable[str], patterns: str = COMMANDS) -> list[str]:
    """
    Select the topics that would command a robot if they were played.

    Parameters
    ----------
    topics
        The names of recorded topics.
    patterns
        Shell patterns separated by spaces. A topic is selected if a pattern matches its full name,
        or the part after one of its slashes.

    """
    words = patterns.split()
    return [topic for topic in topics if _fits(topic.strip('/').split('/'), words)]


def _fits(names: list[str], patterns: list[str]) -> bool:
    endings = ['/'.join(names[start:]) for start in range(len(names))]
    return any(fnmatchcase(ending, pattern) for ending in endings for pattern in patterns)
