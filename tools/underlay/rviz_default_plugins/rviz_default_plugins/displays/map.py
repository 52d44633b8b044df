# SPDX-License-Identifier: Apache-2.0
"""The display of an occupancy grid, as an image in the scene that is updated often."""

from __future__ import annotations

from collections import deque
from typing import Any, ClassVar
from weakref import WeakKeyDictionary

from map_msgs.msg import OccupancyGridUpdate
from nav_msgs.msg import OccupancyGrid
import numpy as np
from rviz_common.properties import Choice, Flag, Number, topic_properties, Whole
from rviz_common.status import Level
from rviz_common.topic_display import MessageDisplay
from rviz_default_plugins.decoding.geometry import position, Quaternion, rotated, rotation, Triple
from rviz_default_plugins.decoding.occupancy import (
    apply_update,
    binary,
    Cells,
    cells_of,
    png_of,
    thinned,
)

__all__ = ['Map']

MOST = 1500
"""The maximum number of cells along a side; larger images take too long to encode."""
BEHIND, LOWEST, STEP = -0.04, -0.032, 0.008
"""Heights in m: maps are stacked slightly below everything else on the ground."""
LOOK = ('Alpha', 'Color Scheme', 'Binary representation', 'Binary threshold')
MOST_WAITING = 1000
MOST_WAITING_CELLS = 100_000_000
"""The maximum number of cells, of a byte each, in the queued updates."""

NOTHING = np.zeros((1, 1, 4), np.uint8)


class Map(MessageDisplay):
    """The newest map of a topic, with the updates that another one brings."""

    CLASS = 'rviz_default_plugins/Map'
    MESSAGE = OccupancyGrid
    PROPERTIES = (
        *topic_properties('nav_msgs/msg/OccupancyGrid', '/map'),
        *topic_properties('map_msgs/msg/OccupancyGridUpdate', path='Update Topic'),
        Number('Alpha', 0.7, '0 is transparent.', 0.0, 1.0),
        Choice('Color Scheme', 'map', 'How values are coloured.', ('map', 'costmap', 'raw')),
        Flag('Draw Behind', False, 'Whether the map is drawn behind objects at the same height.'),
        Flag('Binary representation', False, 'Whether cells are shown only as free or occupied.'),
        Whole('Binary threshold', 100, 'Minimum value of occupied cells.', 0, 100),
    )
    UNUSED = ('Use Timestamp',)
    _layers: ClassVar[WeakKeyDictionary[Any, set[int]]] = WeakKeyDictionary()
    """The layers in use, by page: where maps overlap, the later one is on top."""

    def start(self) -> None:
        """Subscribe to the map and its updates."""
        taken = self._layers.setdefault(self.context.scene, set())
        self._layer = next(layer for layer in range(len(taken) + 1) if layer not in taken)
        taken.add(self._layer)
        self._picture = _FlatPicture(self.context.scene, f'{self.root}/map')
        self._shown_as: tuple[Any, ...] = ()
        self._shown_cells: Cells = np.empty((0, 0), np.int8)
        self._of: Any = None
        self._cells: Cells | None = None
        self._updates = _Updates()
        super().start()
        topic = self.values['Update Topic/Value'] or f'{self.values["Topic/Value"]}_updates'
        if self.values['Topic/Value']:
            self.subscribe(OccupancyGridUpdate, topic, self._take_update, 'Update Topic')

    def stop(self) -> None:
        """Unsubscribe, and remove everything that was drawn."""
        self._picture.remove()
        self._layers[self.context.scene].discard(self._layer)
        super().stop()

    def take(self, message: Any) -> None:
        """
        Store the newest map, and drop the queued updates, which belong to the previous one.

        Parameters
        ----------
        message
            As for `TopicDisplay.take`.

        """
        super().take(message)
        self._updates.clear()

    def update(self) -> None:
        """Show the newest map with its updates applied, and follow its frame."""
        if self._updates and self._of is self._newest and self._cells is not None:
            self._apply(self._cells)
            self.redraw()
        super().update()

    def show(self, message: Any) -> None:
        """
        Draw the map as an image that lies on the ground.

        Parameters
        ----------
        message
            As for `MessageDisplay.show`.

        """
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
        self._draw(cells, step, message.info)

    def _draw(self, cells: Cells, step: int, info: Any) -> None:
        """Draw cells, unless they are already drawn: many costmaps arrive unchanged."""
        at, turn = position(info.origin.position, 'origin'), rotation(info.origin.orientation)
        height, width = (length * step * info.resolution for length in cells.shape)
        height_m = min(LOWEST + STEP * self._layer, -STEP / 2.0)
        behind = BEHIND if self.values['Draw Behind'] else height_m
        x, y, z = rotated(np.array([[width / 2.0, height / 2.0, behind]]), turn)[0] + at
        shown_as = (width, height, float(x), float(y), float(z), turn, *self._look())
        if shown_as == self._shown_as and np.array_equal(cells, self._shown_cells):
            return
        self._shown_as, self._shown_cells = shown_as, cells.copy()
        if self.values['Binary representation']:
            cells = binary(cells, self.values['Binary threshold'])
        png = png_of(cells, self.values['Color Scheme'], self.values['Alpha'])
        self._picture.show(png, (width, height), (float(x), float(y), float(z)), turn)

    def _look(self) -> tuple[Any, ...]:
        """Return the properties that determine the look of cells."""
        return tuple(self.values[path] for path in LOOK)

    def _take_update(self, message: Any) -> None:
        self._updates.add(message)

    def _apply(self, cells: Cells) -> None:
        self.status.forget('Update Topic')
        if self._updates.lost:
            sentence = f'Too many updates at once: {self._updates.lost} left out (the oldest).'
            self.status.say('Update Topic', Level.WARN, sentence)
        for each in self._updates.take():
            try:
                apply_update(cells, each)
            except ValueError as error:
                self.status.say('Update Topic', Level.ERROR, f'An update is left out: {error}')


class _Updates:
    """A queue of map updates, limited in number and size; the oldest are dropped."""

    def __init__(self) -> None:
        self.clear()

    def __bool__(self) -> bool:
        """Whether updates are queued or were lost."""
        return bool(self._waiting or self.lost)

    def add(self, update: Any) -> None:
        """Add an update; drop the oldest ones when the queue is full."""
        self._waiting.append(update)
        self._cells += len(update.data)
        while len(self._waiting) > MOST_WAITING or self._cells > MOST_WAITING_CELLS:
            self._cells -= len(self._waiting.popleft().data)
            self.lost += 1

    def take(self) -> list[Any]:
        """Remove and return all updates, in the order of arrival."""
        updates = list(self._waiting)
        self.clear()
        return updates

    def clear(self) -> None:
        """Clear the queue."""
        self._waiting: deque[Any] = deque()
        self._cells = self.lost = 0


class _FlatPicture:
    """
    A flat image in the scene, given as a PNG file.

    The scene of viser accepts pixels and encodes them itself, with three bytes of colour each; a
    palette of 256 colours is encoded in a seventh of the time, to a sixth of the size.

    Parameters
    ----------
    scene
        The scene of the viser server.
    path
        The path of the image in the scene; no node exists before `show`.

    """

    def __init__(self, scene: Any, path: str) -> None:
        self._scene, self._path = scene, path
        self._handle: Any = None
        self._place: tuple[Any, ...] = ()

    def show(
        self, png: bytes, size_m: tuple[float, float], position: Triple, wxyz: Quaternion
    ) -> None:
        """
        Show an image, replacing the previous one.

        Parameters
        ----------
        png
            The contents of a PNG file.
        size_m
            Width and height, in m.
        position
            The centre of the image, in m in the frame of the parent node.
        wxyz
            Its rotation, as w, x, y and z.

        """
        place = (size_m, position, wxyz)
        if self._handle is None:
            width, height = size_m
            self._handle = self._scene.add_image(
                self._path, NOTHING, width, height, format='png', position=position, wxyz=wxyz
            )
        elif place != self._place:
            self._handle.render_width, self._handle.render_height = size_m
            self._handle.position, self._handle.wxyz = position, wxyz
        self._place = place
        self._handle._data = png

    def remove(self) -> None:
        """Remove the image."""
        if self._handle is not None:
            self._handle.remove()
            self._handle = None
