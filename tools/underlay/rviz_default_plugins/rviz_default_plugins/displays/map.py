# SPDX-License-Identifier: Apache-2.0
"""A map of cells that are free or occupied."""

from __future__ import annotations

import importlib
from typing import Any

from nav_msgs.msg import OccupancyGrid
import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.message_display import MessageDisplay
from rviz_common.properties import Choice, Flag, Number, topic_properties, Whole
from rviz_common.status import Level
from rviz_default_plugins.decoding.geometry import position, rotated, rotation
from rviz_default_plugins.decoding.occupancy import (
    apply_update,
    binary,
    Cells,
    cells_of,
    paint,
    thinned,
)

__all__ = ['Map']

MOST = 1500
"""Cells along a side; a picture of more takes too long to be packed."""
BEHIND = -0.01


class Map(MessageDisplay):
    """The newest map of a topic, with the updates that another one brings."""

    CLASS = 'rviz_default_plugins/Map'
    MESSAGE = OccupancyGrid
    PROPERTIES = (
        *topic_properties('nav_msgs/msg/OccupancyGrid', '/map'),
        *topic_properties('map_msgs/msg/OccupancyGridUpdate', path='Update Topic'),
        Number('Alpha', 0.7, '0 is transparent.', 0.0, 1.0),
        Choice('Color Scheme', 'map', 'What the values look like.', ('map', 'costmap', 'raw')),
        Flag('Draw Behind', False, 'Whether the map is below what is at the same height.'),
        Flag('Binary representation', False, 'Whether cells are either free or occupied.'),
        Whole('Binary threshold', 100, 'Least value of occupied cells.', 0, 100),
    )
    UNUSED = ('Use Timestamp',)

    def start(self) -> None:
        """Subscribe the map and its updates."""
        self._canvas = Canvas(self.context.scene, self.root)
        self._of: Any = None
        self._cells: Cells | None = None
        self._updates: list[Any] = []
        super().start()
        topic = self.values['Update Topic/Value'] or f'{self.values["Topic/Value"]}_updates'
        kind = _update_type()
        if kind is None:
            self.status.say(
                'Update Topic',
                Level.OK,
                f'{topic} is not subscribed: the package map_msgs is not installed.',
            )
        elif self.values['Topic/Value']:
            self.subscribe(kind, topic, self._take_update, 'Update Topic')

    def take(self, message: Any) -> None:
        """Keep the newest map; updates from before are of another one."""
        super().take(message)
        self._updates.clear()

    def update(self) -> None:
        """Show the newest map, changed as the updates say, and follow its frame."""
        if self._updates and self._of is self._newest and self._cells is not None:
            self._apply(self._cells)
            self.redraw()
        super().update()

    def show(self, message: Any) -> None:
        """Draw the map as a picture that lies on the ground."""
        if self._of is not message:
            self._cells = None
            self._cells, self._of = cells_of(message), message
        assert self._cells is not None
        cells, step = thinned(self._cells, MOST)
        if step > 1:
            height, width = self._cells.shape
            sentence = f'One of {step} x {step} of the {width} x {height} cells is shown.'
            self.status.say('Map', Level.WARN, sentence)
        else:
            self.status.forget('Map')
        with self._canvas.anew():
            self._add(cells, step, message.info)

    def _add(self, cells: Cells, step: int, info: Any) -> None:
        if self.values['Binary representation']:
            cells = binary(cells, self.values['Binary threshold'])
        picture = paint(cells, self.values['Color Scheme'], self.values['Alpha'])
        at, turn = position(info.origin.position, 'origin'), rotation(info.origin.orientation)
        height, width = (length * step * info.resolution for length in cells.shape)
        behind = BEHIND if self.values['Draw Behind'] else 0.0
        middle = rotated(np.array([[width / 2.0, height / 2.0, behind]]), turn)[0] + at
        self._canvas.put(
            'image',
            'map',
            image=picture,
            render_width=width,
            render_height=height,
            format='png',
            position=tuple(middle),
            wxyz=turn,
        )

    def _take_update(self, message: Any) -> None:
        self._updates.append(message)
        del self._updates[:-1000]

    def _apply(self, cells: Cells) -> None:
        updates, self._updates = self._updates, []
        self.status.forget('Update Topic')
        for each in updates:
            try:
                apply_update(cells, each)
            except ValueError as error:
                self.status.say('Update Topic', Level.ERROR, f'An update is left out: {error}')


def _update_type() -> type | None:
    """Return the type of updates, which is not installed everywhere."""
    try:
        kind: type = importlib.import_module('map_msgs.msg').OccupancyGridUpdate
    except ImportError:
        return None
    return kind
