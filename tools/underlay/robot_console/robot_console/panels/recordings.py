# SPDX-License-Identifier: Apache-2.0
"""Panel to record, save the last seconds, play and export."""

from __future__ import annotations

import os

from robot_console.namespaces import NAMESPACE
from robot_console.recordings.bags import COMMANDS
from robot_console.recordings.memory_folder import MemoryFolder
from robot_console.recordings.play_folder import PlayFolder
from robot_console.recordings.record_folder import RecordFolder
from robot_console.recordings.scene_folder import SceneFolder
from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.properties import Flag, Number, Text

__all__ = ['Recordings']

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
