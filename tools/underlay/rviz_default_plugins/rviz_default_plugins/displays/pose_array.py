# SPDX-License-Identifier: Apache-2.0
"""Arrows or axes at many poses."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PoseArray as PoseArrayMessage
import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.properties import Choice, ColorOf, Number, topic_properties
from rviz_common.status import Level
from rviz_common.topic_display import MessageDisplay
from rviz_default_plugins.bodies import add_copies, add_lines, arrow
from rviz_default_plugins.decoding.geometry import matrices_of, Points, points_of, rotations_of

__all__ = ['PoseArray']

FLAT, SOLID, AXES = 'Arrow (Flat)', 'Arrow (3D)', 'Axes'
MOST = 20000


class PoseArray(MessageDisplay):
    """The newest poses of a topic, such as the particles of a localization."""

    CLASS = 'rviz_default_plugins/PoseArray'
    MESSAGE = PoseArrayMessage
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PoseArray', '/particlecloud'),
        Choice('Shape', FLAT, 'How a pose is drawn.', (FLAT, SOLID, AXES)),
        ColorOf('Color', (255, 25, 0), 'Colour of the arrows.'),
        Number('Alpha', 1.0, '0 is transparent.', 0.0, 1.0),
        Number('Arrow Length', 0.3, 'Length of flat arrows, in metres.', 0.0),
        Number('Shaft Length', 0.23, 'Length of the shafts, in metres.', 0.0),
        Number('Shaft Radius', 0.01, 'Radius of the shafts, in metres.', 0.0),
        Number('Head Length', 0.07, 'Length of the heads, in metres.', 0.0),
        Number('Head Radius', 0.03, 'Radius of the heads, in metres.', 0.0),
        Number('Axes Length', 0.3, 'Length of the axes, in metres.', 0.0),
        Number('Axes Radius', 0.01, 'Radius of the axes, in metres.', 0.0),
    )

    def start(self) -> None:
        """Subscribe to the topic."""
        self._canvas = Canvas(self.context.scene, self.root)
        super().start()

    def show(self, message: Any) -> None:
        """
        Draw all poses as one node of the scene.

        Parameters
        ----------
        message
            As for `MessageDisplay.show`.

        """
        step = max(1, -(-len(message.poses) // MOST))
        positions, wxyzs = self._poses(message.poses[::step])
        draw = {FLAT: self._add_flat, SOLID: self._add_solid, AXES: self._add_axes}
        with self._canvas.anew():
            if len(positions):
                draw[self.values['Shape']](positions, wxyzs)
        if step > 1:
            self.status.say(
                'Number',
                Level.WARN,
                f'{len(positions)} of {len(message.poses)} poses are shown.',
            )
        else:
            self.status.forget('Number')

    def _poses(self, poses: Any) -> tuple[Points, Points]:
        """Return the valid poses, and report the number of invalid ones."""
        positions = points_of(each.position for each in poses)
        wxyzs, valid = rotations_of(each.orientation for each in poses)
        valid &= np.isfinite(positions).all(axis=1)
        if lost := len(valid) - int(valid.sum()):
            self.status.say(
                'Poses',
                Level.WARN,
                f'{lost} of {len(valid)} poses are left out: they have numbers that are not '
                'finite, or quaternions of zeros.',
            )
        else:
            self.status.forget('Poses')
        return positions[valid], wxyzs[valid]

    def _add_flat(self, positions: Points, wxyzs: Points) -> None:
        """Add arrows made of lines: one for the shaft and two for the head."""
        length = self.values['Arrow Length']
        tip, back, side = (length, 0, 0), 0.8 * length, 0.1 * length
        lines = [((0, 0, 0), tip), (tip, (back, side, 0)), (tip, (back, -side, 0))]
        ends = np.array(lines, dtype=np.float32)
        turned = ends.reshape(-1, 3) @ matrices_of(wxyzs).transpose(0, 2, 1)
        segments = turned + positions[:, None]
        add_lines(self._canvas, 'lines', segments.reshape(-1, 2, 3), self.values['Color'])

    def _add_solid(self, positions: Points, wxyzs: Points) -> None:
        names = ('Shaft Length', 'Shaft Radius', 'Head Length', 'Head Radius')
        surface = arrow(*(self.values[name] for name in names))
        paint = self.values['Color'], self.values['Alpha']
        add_copies(self._canvas, 'arrows', surface, paint, positions, wxyzs)

    def _add_axes(self, positions: Points, wxyzs: Points) -> None:
        self._canvas.put(
            'batched_axes',
            'axes',
            batched_wxyzs=wxyzs,
            batched_positions=positions,
            axes_length=self.values['Axes Length'],
            axes_radius=self.values['Axes Radius'],
        )
