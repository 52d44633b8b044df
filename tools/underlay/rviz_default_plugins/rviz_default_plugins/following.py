# SPDX-License-Identifier: Apache-2.0
"""Moving the node of a display with a frame."""

from __future__ import annotations

from typing import Any

from rviz_common.display import Display
from rviz_common.frames import FrameError, Pose
from rviz_common.status import Level

__all__ = ['follow']


def follow(display: Display, node: Any, frame: str) -> None:
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
