# SPDX-License-Identifier: Apache-2.0
"""Which recordings a folder has, what they contain, and the widgets to select one."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from datetime import datetime
from fnmatch import fnmatchcase
from html import escape
import os
import threading
from typing import Any, NamedTuple

from robot_console.recordings.widgets import assign, clock_text, size_text
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.metadata import FILE_NAME
from rviz_common.context import Context
from rviz_common.pace import Pace
from rviz_common.status import escaped, printable

__all__ = [
    'COMMANDS',
    'Bag',
    'BagChooser',
    'BagTopic',
    'Shelf',
    'about',
    'commands_among',
    'topics_table',
]

MOST = 200
NS_PER_S = 1e9
NONE = '(none)'
PERIOD_S = 4.0
TABLE = 'width: 100%; font-size: 0.8em; overflow-wrap: anywhere; padding: 0 0.5em'

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


class BagChooser:
    """
    Widgets to select a recording from a folder, which is read in a background thread.

    Call `add_details` once before the first `update`.

    Parameters
    ----------
    context
        The context of the panel; the widgets are added at the current position of its GUI.
    folder
        The path of the folder.
    unfinished
        Returns the path of the recording in progress, which is not listed; '' if there is none.
    chosen
        Called when another recording is selected.

    """

    def __init__(
        self,
        context: Context,
        folder: str,
        unfinished: Callable[[], str],
        chosen: Callable[[], None],
    ) -> None:
        self._context = context
        self._shelf = Shelf(folder)
        self._unfinished = unfinished
        self._chosen = chosen
        self._pace = Pace(PERIOD_S)
        self._is_looking = self._is_over = False
        self._wanted = ''
        self._bags: dict[str, Bag] = {}
        self._list: Any = context.gui.add_dropdown('Recording', [NONE])
        self._text: Any = context.gui.add_markdown('')
        context.on_input(self._list, self._choose)

    def add_details(self) -> None:
        """Add the widget with the topics, which may be placed elsewhere."""
        gui = self._context.gui
        self._topics: Any = gui.add_folder('Topics', expand_by_default=False, visible=False)
        with self._topics:
            self._details: Any = gui.add_html('')

    @property
    def bag(self) -> Bag | None:
        """Return the selected recording if it can be played, else None."""
        bag = self._bags.get(self._list.value)
        return None if bag is None or bag.problem else bag

    def update(self) -> None:
        """Rescan the folder periodically, in a background thread."""
        if not self._is_looking and self._pace.is_due():
            self._is_looking = True
            threading.Thread(target=self._look, daemon=True).start()

    def choose(self, path: str) -> None:
        """
        Select a new recording as soon as it is found in the folder.

        Parameters
        ----------
        path
            The path of the recording.

        """
        self._wanted = path
        self._pace.hurry()

    def close(self) -> None:
        """Stop updating the widgets, even if a scan is still running."""
        self._is_over = True

    def _look(self) -> None:
        unfinished = self._unfinished()  # it may finish during the scan, after it was read
        try:
            bags = self._shelf.look()
        finally:
            self._is_looking = False
        self._context.queue.post(lambda: self._take(bags, unfinished))

    def _take(self, bags: list[Bag], unfinished: str) -> None:
        if self._is_over:
            return
        left_out = (unfinished, self._unfinished())
        found = {_label(bag): bag for bag in bags if bag.path not in left_out}
        if found != self._bags:
            self._bags = found
            before = self._list.value
            assign(self._list, options=tuple(found) or (NONE,))
            for label in (each for each, bag in found.items() if bag.path == self._wanted):
                self._wanted = ''
                assign(self._list, value=label)
            if self._list.value != before:
                self._chosen()
        self._describe()

    def _choose(self, label: str) -> None:
        self._describe()
        self._chosen()

    def _describe(self) -> None:
        bag = self._bags.get(self._list.value)
        if bag is None:
            head = f'No recordings in {escaped(_short(self._shelf.folder))} yet.'
        else:
            head = about(bag)
        topics = bag.topics if bag is not None else ()
        if self._shelf.left_out_count:
            head += f'\n\n{self._shelf.left_out_count} older ones are not listed.'
        assign(self._text, content=head)
        assign(self._details, content=topics_table(topics))
        assign(self._topics, visible=bool(topics))


def _label(bag: Bag) -> str:
    return f'{bag.name} ✖' if bag.problem else f'{bag.name} ({clock_text(bag.duration_s)})'


def _short(path: str) -> str:
    home = os.path.expanduser('~')
    return f'~{path[len(home) :]}' if path.startswith(f'{home}/') else path


def about(bag: Bag) -> str:
    """
    Describe a recording in Markdown: start, duration, messages and size, or its problem.

    Parameters
    ----------
    bag
        The recording.

    """
    if bag.problem:
        return f'✖ {escaped(bag.problem)}'
    start = datetime.fromtimestamp(bag.start_s).strftime('%Y-%m-%d %H:%M:%S')
    return (
        f'{start}, {clock_text(bag.duration_s)}, {bag.message_count} messages, '
        f'{size_text(bag.size_bytes)}'
    )


def topics_table(topics: Iterable[BagTopic]) -> str:
    """
    Render the topics of a recording as an HTML table that fits the width of the panel.

    Parameters
    ----------
    topics
        The topics, with their types and message counts.

    """
    rows = ''.join(
        f'<tr style="vertical-align: top"><td style="padding-bottom: 0.3em">{escape(each.name)}'
        f'<br><span style="opacity: 0.6">{escape(each.type_name)}</span></td>'
        f'<td style="text-align: right">{escape(str(each.message_count))}</td></tr>'
        for each in topics
    )
    return f'<table style="{TABLE}"><tbody>{rows}</tbody></table>'
