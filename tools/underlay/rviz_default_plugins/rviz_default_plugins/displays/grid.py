# SPDX-License-Identifier: Apache-2.0
"""The display of a grid, as a size reference."""

from __future__ import annotations

from rviz_common.display import Display
from rviz_common.frames import FIXED_FRAME
from rviz_common.properties import Choice, ColorOf, Frame, Number, Vector, Whole
from rviz_common.status import Level
from rviz_default_plugins.following import follow
from rviz_default_plugins.grid_lines import AXES, GridSize, in_pieces, lines

__all__ = ['Grid']

MAX_LINES = 20000
BACKGROUND = 48  # RViz's grey, which translucent lines are blended with
LINES, BILLBOARDS = 'Lines', 'Billboards'


class Grid(Display):
    """A plane of square cells, or several above each other."""

    CLASS = 'rviz_default_plugins/Grid'
    PROPERTIES = (
        Frame('Reference Frame', FIXED_FRAME, 'The frame in whose origin the grid is.'),
        Whole('Plane Cell Count', 10, 'How many cells the plane has along a side.', 1),
        Whole('Normal Cell Count', 0, 'How many cells are above each other.', 0),
        Number('Cell Size', 1.0, 'How long a side of a cell is, in metres.', 0.0001, 1e9),
        Choice(
            'Line Style/Value',
            LINES,
            'Lines are as thin on the screen as they can be.',
            (LINES, BILLBOARDS),
        ),
        Number('Line Style/Line Width', 0.03, 'How thick billboards are, in metres.', 0.001, 1e9),
        ColorOf('Color', (160, 160, 164), 'The colour of the lines.'),
        Number('Alpha', 0.5, 'How opaque the lines are, from 0 to 1.', 0.0, 1.0),
        Choice('Plane', 'XY', 'Which plane the grid is in.', tuple(AXES)),
        Vector('Offset', (0.0, 0.0, 0.0), 'How far the grid is from its frame, in metres.'),
    )

    def start(self) -> None:
        """Add the grid."""
        self._frame = self.context.scene.add_frame(self.root, show_axes=False)
        size = self._size()
        pieces = max(1, min(size.cells, MAX_LINES // size.line_count))
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
        follow(self, self._frame, self.values['Reference Frame'])

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
