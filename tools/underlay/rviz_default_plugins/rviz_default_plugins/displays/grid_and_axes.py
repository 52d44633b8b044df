# SPDX-License-Identifier: Apache-2.0
"""The displays that need no topic, but follow a frame: a grid, as a size reference, and axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rviz_common.display import Display
from rviz_common.frames import FIXED_FRAME, FrameError, Pose
from rviz_common.properties import Choice, ColorOf, Frame, Number, Vector, Whole
from rviz_common.status import Level

__all__ = ['Axes', 'Grid', 'GridSize', 'in_pieces', 'lines']

MAX_LINES = 20000
PIECE_CELLS = 10
"""The length of the pieces in which lines are drawn, in cells: each piece is six triangles."""
BACKGROUND = 48  # RViz's grey, which translucent lines are blended with
LINES, BILLBOARDS = 'Lines', 'Billboards'

AXES = {'XY': (0, 1, 2), 'XZ': (0, 2, 1), 'YZ': (1, 2, 0)}
"""The indices of the two in-plane coordinates of a grid, and of its normal."""


class Grid(Display):
    """A plane of square cells, or several above each other."""

    CLASS = 'rviz_default_plugins/Grid'
    PROPERTIES = (
        Frame('Reference Frame', FIXED_FRAME, 'The frame of the grid.'),
        Whole('Plane Cell Count', 10, 'Number of cells along each side of the plane.', 1),
        Whole('Normal Cell Count', 0, 'Number of cells along the normal of the plane.', 0),
        Number('Cell Size', 1.0, 'Side length of a cell, in metres.', 0.0001, 1e9),
        Choice(
            'Line Style/Value',
            LINES,
            'Lines are as thin as the screen allows.',
            (LINES, BILLBOARDS),
        ),
        Number('Line Style/Line Width', 0.03, 'Width of billboards, in metres.', 0.001, 1e9),
        ColorOf('Color', (160, 160, 164), 'The colour of the lines.'),
        Number('Alpha', 0.5, 'Opacity of the lines, from 0 to 1.', 0.0, 1.0),
        Choice('Plane', 'XY', 'The plane of the grid.', tuple(AXES)),
        Vector('Offset', (0.0, 0.0, 0.0), 'Offset of the grid from its frame, in metres.'),
    )

    def start(self) -> None:
        """Add the grid."""
        self._frame = self.context.scene.add_frame(self.root, show_axes=False)
        size = self._size()
        pieces = max(1, min(size.cells // PIECE_CELLS, MAX_LINES // size.line_count))
        is_thin = self.values['Line Style/Value'] == LINES
        self.context.scene.add_line_segments(
            f'{self.root}/lines',
            in_pieces(lines(size, self.values['Plane']), pieces),
            self._color(),
            thickness=1.0 if is_thin else self.values['Line Style/Line Width'],
            thickness_units='screen' if is_thin else 'world',
            position=self.values['Offset'],
        )

    def stop(self) -> None:
        """Remove the grid."""
        self._frame.remove()
        self.status.clear()

    def update(self) -> None:
        """Move the grid to its frame."""
        _follow(self, self._frame, self.values['Reference Frame'])

    def _size(self) -> GridSize:
        wanted = GridSize(
            self.values['Plane Cell Count'],
            self.values['Normal Cell Count'],
            self.values['Cell Size'],
        )
        if wanted.line_count <= MAX_LINES:
            return wanted
        size = wanted.within(MAX_LINES)
        self.status.say(
            'Grid',
            Level.WARN,
            f'{wanted.line_count} lines are too many: {size.line_count} are shown, {size.cells} '
            f'cells wide and {size.layers} high. Choose larger cells.',
        )
        return size

    def _color(self) -> tuple[int, int, int]:
        alpha = self.values['Alpha']
        red, green, blue = (
            round(alpha * part + (1.0 - alpha) * BACKGROUND) for part in self.values['Color']
        )
        return red, green, blue


class Axes(Display):
    """The axes of a frame: x red, y green, z blue."""

    CLASS = 'rviz_default_plugins/Axes'
    PROPERTIES = (
        Frame('Reference Frame', FIXED_FRAME, 'The frame whose axes are shown.'),
        Number('Length', 1.0, 'Length of the axes, in metres.', 0.001),
        Number('Radius', 0.1, 'Radius of the axes, in metres.', 0.001),
    )
    UNUSED = ('Alpha', 'Show Trail')

    def start(self) -> None:
        """Add the axes."""
        self._axes = self.context.scene.add_frame(
            self.root,
            axes_length=self.values['Length'],
            axes_radius=self.values['Radius'],
            origin_radius=self.values['Radius'],
        )

    def stop(self) -> None:
        """Remove the axes."""
        self._axes.remove()
        self.status.clear()

    def update(self) -> None:
        """Move the axes to their frame."""
        _follow(self, self._axes, self.values['Reference Frame'])


def _follow(display: Display, node: Any, frame: str) -> None:
    """
    Move a node of the scene to a frame; hide it if there is no transform to it.

    Parameters
    ----------
    display
        The display, whose status reports why the node is hidden.
    node
        The handle of viser for the node.
    frame
        The name of the frame, or `FIXED_FRAME`.

    """
    try:
        pose: Pose = display.context.frames.pose(frame)
    except FrameError as error:
        display.status.say('Transform', Level.ERROR, str(error))
        node.visible = False
        return
    display.status.forget('Transform')
    node.visible = True
    node.position, node.wxyz = pose


@dataclass(frozen=True)
class GridSize:
    """The number of square cells of a grid in its plane and across it, and their size."""

    cells: int
    layers: int
    cell_m: float

    @property
    def line_count(self) -> int:
        """The number of lines."""
        across = (self.cells + 1) ** 2 if self.layers else 0
        return 2 * (self.cells + 1) * (self.layers + 1) + across

    def within(self, limit: int) -> GridSize:
        """
        Find a grid with as many cells as possible, but no more lines than a limit.

        Parameters
        ----------
        limit
            The maximum number of lines; at most an eighth of it are layers.

        Returns
        -------
        GridSize
            The grid, with cells of the same size.

        """
        layers = min(self.layers, limit // 8)
        fitting, too_many = 1, self.cells + 1
        while too_many - fitting > 1:
            cells = (fitting + too_many) // 2
            if GridSize(cells, layers, self.cell_m).line_count <= limit:
                fitting = cells
            else:
                too_many = cells
        return GridSize(fitting, layers, self.cell_m)


def lines(size: GridSize, plane: str) -> NDArray[np.float32]:
    """
    Compute the lines of a grid around the origin.

    Parameters
    ----------
    size
        The size of the grid.
    plane
        The plane that it is in: `XY`, `XZ` or `YZ`.

    Returns
    -------
    NDArray[np.float32]
        The ends of N lines (N, 2, 3), in m.

    """
    first, second, across = AXES[plane]
    steps = _steps(size.cells, size.cell_m)
    heights = _steps(size.layers, size.cell_m)
    both_ends = steps[[0, -1]]
    groups = [
        _group(first, both_ends, second, steps, across, heights),
        _group(second, both_ends, first, steps, across, heights),
    ]
    if size.layers:
        groups.append(_group(across, heights[[0, -1]], first, steps, second, steps))
    return np.concatenate(groups)


def in_pieces(whole: NDArray[np.float32], count: int) -> NDArray[np.float32]:
    """
    Cut each line into pieces of the same length.

    A browser misjudges the depth of a line that starts behind the viewer: short lines avoid this.

    Parameters
    ----------
    whole
        The ends of N lines (N, 2, 3).
    count
        The number of pieces of each.

    Returns
    -------
    NDArray[np.float32]
        The ends of the pieces (N count, 2, 3).

    """
    shares = np.linspace(0.0, 1.0, count + 1, dtype=np.float32)[:, None]
    points = whole[:, None, 0] + shares * (whole[:, None, 1] - whole[:, None, 0])
    return np.stack([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 2, 3)


def _steps(count: int, length: float) -> NDArray[np.float32]:
    half = count / 2.0
    return np.linspace(-half * length, half * length, count + 1, dtype=np.float32)


def _group(
    along: int,
    ends: NDArray[np.float32],
    first: int,
    first_steps: NDArray[np.float32],
    second: int,
    second_steps: NDArray[np.float32],
) -> NDArray[np.float32]:
    """Return parallel lines, one for each pair of steps."""
    a, b = (each.ravel() for each in np.meshgrid(first_steps, second_steps))
    found = np.empty((len(a), 2, 3), np.float32)
    found[:, :, along] = ends
    found[:, :, first] = a[:, None]
    found[:, :, second] = b[:, None]
    return found
