# SPDX-License-Identifier: Apache-2.0
"""Widgets to record topics, and the names and topic filters of recordings."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
import os
import re
import time
from typing import Any

from robot_console.recordings.child import Child
from robot_console.recordings.widgets import assign, clock_text, size_text
from rviz_common.context import Context
from rviz_common.status import escaped, printable
from rviz_common.topics import full_topic_name

__all__ = ['RecordFolder', 'bag_folder', 'regex_of_robot', 'topics_in']

SHARED = 'tf|tf_static|clock'
SEPARATOR = re.compile(r'[\s,]+')

ADD = 'Add a topic ...'
RECORD, STOP = 'Record', 'Stop recording'


def bag_folder(folder: str, name: str, now: datetime) -> str:
    """
    Choose the path of a new recording; nothing is created.

    Parameters
    ----------
    folder
        The folder of all recordings.
    name
        The name given by the user; if blank, it is derived from the time.
    now
        The time used for such a name.

    Raises
    ------
    ValueError
        The name is not a valid file name, or the recording already exists; the message is a full
        sentence.

    """
    name = name.strip()
    if name.startswith('.') or '/' in name or '\0' in name:
        raise ValueError(
            f"'{name}' is not a valid name of a recording: no slashes, and no leading dot."
        )
    if not name:
        return _free(os.path.join(folder, now.strftime('%Y-%m-%d_%H-%M-%S')))
    path = os.path.join(folder, name)
    if os.path.lexists(path):
        raise ValueError(f"There is already a recording '{name}'. Choose another name.")
    return path


def regex_of_robot(namespace: str) -> str:
    """
    Build the regular expression for the topics of one robot and the topics shared by all robots.

    Parameters
    ----------
    namespace
        The namespace of the robot, without leading and trailing slashes.

    Returns
    -------
    str
        The expression; '' for no namespace, which means all topics.

    """
    return f'^/({re.escape(namespace)}/.+|{SHARED})$' if namespace else ''


def topics_in(text: str) -> list[str]:
    """
    Split a text into the topics that it lists, without duplicates.

    Parameters
    ----------
    text
        Names separated by spaces, line breaks or commas.

    """
    return list(dict.fromkeys(word for word in SEPARATOR.split(text) if word))


def _free(path: str) -> str:
    """Return a path that does not exist yet."""
    number, free = 1, path
    while os.path.lexists(free):
        number += 1
        free = f'{path}_{number}'
    return free


class RecordFolder:
    """
    Widgets to record all topics of a robot, or selected ones, in a child process.

    Parameters
    ----------
    context
        The context of the panel.
    folder
        The path of the folder in which recordings are made; created if necessary.
    namespace
        The namespace of the robot whose topics are recorded; '' for all topics.
    done
        Called with the path of a recording when it has ended, even if it failed.

    """

    def __init__(
        self,
        context: Context,
        folder: str,
        namespace: str,
        done: Callable[[str], None],
    ) -> None:
        self._context, self._folder = context, folder
        self._namespace, self._done = namespace, done
        self._child: Child | None = None
        self._path = ''
        self._start_s: float | None = None
        gui = context.gui
        with gui.add_folder('Record'):
            self._name: Any = gui.add_text('Name', '', hint='Default: the current time.')
            self._all: Any = gui.add_checkbox('All topics', True)
            self._topics: Any = gui.add_text('Topics', '', multiline=True, visible=False)
            self._more: Any = gui.add_dropdown('Add', [ADD], visible=False)
            self._button: Any = gui.add_button(
                RECORD, color='red', hint=f'Into {printable(folder)}'
            )
            self._text: Any = gui.add_markdown('')
        context.on_input(self._all, self._choose)
        context.on_input(self._more, self._add)
        context.on_click(self._button, self._press)

    @property
    def path(self) -> str:
        """Return the path of the recording in progress, or ''."""
        return self._path if self._child is not None else ''

    def update(self) -> None:
        """Update the widgets with the state of the recorder."""
        if self._all.value is False and not self._child:
            self._offer_topics()
        if self._child is None:
            return
        if not self._child.is_running:
            self._finish(self._child)
            return
        size, name = _folder_bytes(self._path), escaped(self._name_now())
        if not size:  # the recorder takes its time to start
            assign(self._text, content=f'Starting to record **{name}**')
            return
        if self._start_s is None:
            self._start_s = time.monotonic()
        length = clock_text(time.monotonic() - self._start_s)
        state = 'Finishing' if self._child.is_ending else '● Recording'
        assign(self._text, content=f'{state} **{name}**: {length}, {size_text(size)}')

    def close(self) -> None:
        """Stop the recorder; it finishes the recording."""
        if self._child is not None:
            self._child.close()

    def _press(self) -> None:
        if self._child is not None:
            self._child.end()
            assign(self._button, disabled=True)
            return
        try:
            self._start()
        except (OSError, ValueError) as error:
            assign(self._text, content=f'✖ {escaped(str(error))}')

    def _start(self) -> None:
        chosen = self._chosen()
        os.makedirs(self._folder, exist_ok=True)
        self._path = bag_folder(self._folder, self._name.value, datetime.now())
        arguments = ['-o', self._path, '--disable-keyboard-controls', *chosen]
        self._child, self._start_s = Child('record', arguments), None
        assign(self._button, label=STOP)

    def _chosen(self) -> list[str]:
        """Return the recorder options that select topics, or raise ValueError."""
        if self._all.value:
            regex = regex_of_robot(self._namespace)
            return ['--regex', regex] if regex else ['--all']
        topics = topics_in(self._topics.value)
        if not topics:
            raise ValueError('No topic selected: add some, or record all.')
        # Resolved to absolute names, since the recorder treats arguments with a leading dash as
        # options.
        return ['--topics', *(full_topic_name(self._context.node, each) for each in topics)]

    def _finish(self, child: Child) -> None:
        child.close()
        self._child = None
        assign(self._button, label=RECORD, disabled=False)
        if child.failure:
            text = f'✖ {escaped(child.failure)}'
        else:
            size = size_text(_folder_bytes(self._path))
            text = f'✔ Recorded **{escaped(self._name_now())}**: {size}'
        notes = ''.join(f'\n\n⚠ {escaped(each)}' for each in child.warnings[-3:])
        assign(self._text, content=text + notes)
        self._done(self._path)

    def _name_now(self) -> str:
        return os.path.basename(self._path)

    def _choose(self, everything: bool) -> None:
        assign(self._topics, visible=not everything)
        assign(self._more, visible=not everything)

    def _offer_topics(self) -> None:
        there = [name for name, _ in self._context.node.get_topic_names_and_types()]
        chosen = topics_in(self._topics.value)
        assign(self._more, options=(ADD, *sorted(set(there).difference(chosen))))

    def _add(self, topic: str) -> None:
        if topic != ADD:
            self._topics.value = '\n'.join([*topics_in(self._topics.value), topic])
            self._more.value = ADD


def _folder_bytes(folder: str) -> int:
    """Return the total size of the files in a folder, without reserved space."""
    try:
        with os.scandir(folder) as entries:
            return sum(each.stat().st_size for each in entries if not each.name.startswith('.'))
    except OSError:
        return 0
