# SPDX-License-Identifier: Apache-2.0
"""Panel to record, save the last seconds, play and export; with the widgets that save."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
import os
from typing import Any

from robot_console.namespaces import NAMESPACE
from robot_console.recordings.bags import COMMANDS
from robot_console.recordings.child import Child
from robot_console.recordings.play_folder import PlayFolder
from robot_console.recordings.record_folder import bag_folder, RecordFolder, regex_of_robot
from robot_console.recordings.scene_folder import SceneFolder
from robot_console.recordings.widgets import assign, memory_text
from rviz_common.context import Context
from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.properties import Flag, Number, Text
from rviz_common.status import escaped

__all__ = ['MemoryFolder', 'Recordings']

PERIOD_S = 0.25


class Recordings(Panel):
    """Records and plays with the code of `ros2 bag`, in processes that end with the page."""

    CLASS = 'robot_console/Recordings'
    PROPERTIES = (
        NAMESPACE,
        Text('Folder', '~/bags', 'Folder of the recordings.'),
        Number('Seconds', 30, 'How many of the last seconds are kept.', 1, 600),
        Number('Largest Memory', 200, 'Limit of the messages kept in memory, in MiB.', 1, 4096),
        Number('Largest Page', 50, 'Limit of the scene as one file, in MiB.', 1, 500),
        Flag('Keep Scene', True, 'Whether to keep the last seconds of the scene at the start.'),
        Text('Commands', COMMANDS, 'Patterns of command topics; not played by default.'),
    )

    def start(self) -> None:
        """Add the widgets."""
        values, context = self.values, self.context
        folder = os.path.abspath(os.path.expanduser(values['Folder'].strip() or '~/bags'))
        namespace, seconds = values['Namespace'], values['Seconds']
        limits = seconds, values['Largest Memory']
        self._pace = Pace(PERIOD_S)
        self._record = RecordFolder(context, folder, namespace, self._choose)
        self._memory = MemoryFolder(context, folder, namespace, limits, self._choose)
        self._play = PlayFolder(context, folder, values['Commands'], lambda: self._record.path)
        self._scene = SceneFolder(context, seconds, values['Largest Page'], values['Keep Scene'])
        self._parts = (self._record, self._memory, self._play, self._scene)

    def update(self) -> None:
        """Update the widgets of all folders."""
        self._play.follow()
        if self._pace.is_due():
            for part in self._parts:
                part.update()

    def close(self) -> None:
        """Stop all child processes in order."""
        for part in self._parts:
            part.close()

    def _choose(self, path: str) -> None:
        """Select a new recording for playback."""
        self._play.chooser.choose(path)


class MemoryFolder:
    """
    Widgets to save the messages of the last seconds, which a child process keeps in memory.

    Parameters
    ----------
    context
        The context of the panel.
    folder
        The path of the folder in which recordings are saved; created if necessary.
    namespace
        The namespace of the robot whose topics are buffered; '' for all topics.
    limits
        The limits of the buffer: in s, and in MiB.
    done
        Called with the path of a saved recording.

    """

    def __init__(
        self,
        context: Context,
        folder: str,
        namespace: str,
        limits: tuple[float, float],
        done: Callable[[str], None],
    ) -> None:
        self._folder, self._namespace, self._done = folder, namespace, done
        self._seconds, self._max_mib = limits
        self._child: Child | None = None
        self._saved: Any = None
        gui = context.gui
        with gui.add_folder(f'Messages: last {self._seconds:g} s'):
            self._on: Any = gui.add_checkbox(
                'Keep messages', False, hint=f'In memory, up to {self._max_mib:g} MiB.'
            )
            self._button: Any = gui.add_button('Save', disabled=True)
            self._text: Any = gui.add_markdown('', visible=False)
            self._result: Any = gui.add_markdown('', visible=False)
        context.on_input(self._on, self._turn)
        context.on_click(self._button, self._save)

    def update(self) -> None:
        """Update the status of the message buffer."""
        child = self._child
        if child is None:
            return
        if not child.is_running:
            self._end(child)
            return
        saved = child.facts.get('saved')
        if saved is not None and saved != self._saved:
            self._saved = saved
            self._say_saved(saved)
        text = memory_text(child.facts, self._seconds, self._max_mib)
        assign(self._text, content=text, visible=True)
        assign(self._button, disabled=child.is_ending or not child.facts.get('messages'))

    def close(self) -> None:
        """Stop buffering messages."""
        if self._child is not None:
            self._child.close()

    def _turn(self, is_on: bool) -> None:
        if self._child is not None:
            self._child.end()
        elif is_on:
            regex = regex_of_robot(self._namespace)
            chosen = ['--regex', regex] if regex else []
            limits = ['--seconds', str(self._seconds), '--max-mib', str(self._max_mib)]
            self._child, self._saved = Child('remember', [*limits, *chosen]), None

    def _end(self, child: Child) -> None:
        child.close()
        self._child = None
        failure = child.failure
        assign(
            self._text, content=f'✖ {escaped(failure)}' if failure else '', visible=bool(failure)
        )
        assign(self._button, disabled=True)
        if self._on.value and failure:
            self._on.value = False
        elif self._on.value:
            self._turn(True)

    def _save(self) -> None:
        if self._child is None:
            return
        try:
            os.makedirs(self._folder, exist_ok=True)
            path = bag_folder(self._folder, '', datetime.now())
        except OSError as error:
            assign(self._result, content=f'✖ {escaped(str(error))}', visible=True)
        else:
            self._child.say(save=path)

    def _say_saved(self, saved: dict[str, Any]) -> None:
        if 'failure' in saved:
            text = f'✖ {escaped(saved["failure"])}'
        else:
            name = os.path.basename(saved['folder'])
            text = f'✔ Saved **{escaped(name)}**: {saved["messages"]} messages'
            self._done(saved['folder'])
        assign(self._result, content=text, visible=True)
