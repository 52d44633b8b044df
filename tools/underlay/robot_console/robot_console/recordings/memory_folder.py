# SPDX-License-Identifier: Apache-2.0
"""Widgets to save the messages of the last seconds."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
import os
from typing import Any

from robot_console.recordings.child import Child
from robot_console.recordings.record_folder import bag_folder, regex_of_robot
from robot_console.recordings.widgets import assign, memory_text
from rviz_common.context import Context
from rviz_common.status import escaped

__all__ = ['MemoryFolder']


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
