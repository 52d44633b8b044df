# SPDX-License-Identifier: Apache-2.0
"""Three arrows at a frame."""

from __future__ import annotations

from rviz_common.display import Display
from rviz_common.frames import FIXED_FRAME
from rviz_common.properties import Frame, Number
from rviz_default_plugins.following import follow

__all__ = ['Axes']


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
        follow(self, self._axes, self.values['Reference Frame'])
