# SPDX-License-Identifier: Apache-2.0
"""Keep what a display draws at the place of a frame."""

from __future__ import annotations

from typing import Any

from rviz_common.display import Display
from rviz_common.frames import FrameError, Pose
from rviz_common.status import Level

__all__ = ['follow']


def follow(display: Display, node: Any, frame: str) -> None:
    """Move a node of the scene to where a frame is; hide it, with the reason, if nobody knows."""
    try:
        pose: Pose = display.context.frames.pose(frame)
    except FrameError as error:
        display.status.say('Transform', Level.ERROR, str(error))
        node.visible = False
        return
    display.status.forget('Transform')
    node.visible = True
    node.position, node.wxyz = pose
