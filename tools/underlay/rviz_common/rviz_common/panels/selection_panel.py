# SPDX-License-Identifier: Apache-2.0
"""What is known about the selected object: name, frame, pose, and what its display tells."""

from __future__ import annotations

from collections.abc import Iterator
import math
from typing import Any

from rviz_common.frames import Pose
from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.selection import SceneObject
from rviz_common.status import escaped
from rviz_common.widget_order import SELECTION_ORDER

__all__ = ['SelectionPanel', 'roll_pitch_yaw']

PERIOD_S = 0.2
UPRIGHT = 1.0 - 1e-9
"""The sine of the pitch from which roll and yaw cannot be told apart."""


class SelectionPanel(Panel):
    """The selected object, above the tabs; hidden while nothing is selected."""

    CLASS = 'rviz_common/Selection'
    IS_ALWAYS_VISIBLE = True

    def start(self) -> None:
        """Add the widgets."""
        self._pace = Pace(PERIOD_S)
        self._shown: SceneObject | None = None
        self._folder: Any = self.context.gui.add_folder(
            self.name, order=SELECTION_ORDER, visible=False
        )
        with self._folder:
            self._text = self.context.gui.add_markdown('')

    def update(self) -> None:
        """Show the selected object."""
        chosen = self.context.visualizer.selection.chosen
        if chosen is self._shown and not (chosen is not None and self._pace.is_due()):
            return
        self._shown = chosen
        if chosen is not None:
            text = table(list(rows(chosen, self.context.frames.fixed_frame)))
            if text != self._text.content:
                self._text.content = text
        if self._folder.visible != (chosen is not None):
            self._folder.visible = chosen is not None

    def close(self) -> None:
        """Remove the widgets."""
        self._folder.remove()


def rows(chosen: SceneObject, fixed_frame: str) -> Iterator[tuple[str, str]]:
    """
    List what is known about an object.

    Parameters
    ----------
    chosen
        The object.
    fixed_frame
        The name of the fixed frame.

    Yields
    ------
    tuple[str, str]
        A name and a value, as plain text.

    """
    yield 'Name', chosen.name
    yield 'Frame', chosen.frame
    pose = chosen.pose()
    if pose is None:
        yield f'Pose in {fixed_frame}', 'unknown: no transform says where it is'
    else:
        yield f'Position in {fixed_frame}', ', '.join(f'{x:.3f}' for x in pose.position) + ' m'
        angles = ', '.join(f'{math.degrees(angle):.1f}' for angle in roll_pitch_yaw(pose))
        yield 'Roll, pitch, yaw', f'{angles} °'
    yield from chosen.details()


def table(lines: list[tuple[str, str]]) -> str:
    """
    Format names and values as a table of Markdown.

    Parameters
    ----------
    lines
        Names and values, as plain text.

    """
    first, *rest = (f'| {escaped(name)} | {escaped(value)} |' for name, value in lines)
    return '\n'.join((first, '|---|---|', *rest))


def roll_pitch_yaw(pose: Pose) -> tuple[float, float, float]:
    """
    Convert the rotation of a pose to angles about the fixed axes x, then y, then z, in rad.

    Parameters
    ----------
    pose
        The pose. At a pitch of 90 degrees only roll and yaw together are determined, and roll is
        taken to be 0.

    """
    w, x, y, z = pose.wxyz
    sine = 2.0 * (w * y - z * x)
    if abs(sine) > UPRIGHT:
        sign = math.copysign(1.0, sine)
        return 0.0, sign * math.pi / 2.0, -sign * 2.0 * math.atan2(x, w)
    return (
        math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)),
        math.asin(sine),
        math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)),
    )
