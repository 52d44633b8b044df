# SPDX-License-Identifier: Apache-2.0
"""Held objects: which hand holds what, the message about them, and arm postures to carry them."""

from __future__ import annotations

from collections import UserDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.robot import Array
from humanoid_description.rotations import about_z, quaternion_of
from humanoid_manipulation.obstacle import Obstacle
from humanoid_manipulation.upper_body import Reach, UpperBody
import numpy as np
from std_msgs.msg import Header
from vision_msgs.msg import Detection3D, Detection3DArray, ObjectHypothesisWithPose

__all__ = ['HANGING', 'SOMETHING', 'Held', 'HeldThings', 'carrying', 'held_objects']

SOMETHING = 'something'
"""The name of an unknown held object."""
HANGING = {
    'left': Reach(0.0, (0.0, 0.15, 0.0, -0.5, 0.0, 0.0)),
    'right': Reach(0.0, (0.0, -0.15, 0.0, -0.5, 0.0, 0.0)),
}
"""The postures of idle arms."""
_LEVEL = {
    'left': Reach(0.0, (-0.06, 0.15, 0.0, -2.0, 0.0, 0.49)),
    'right': Reach(0.0, (-0.06, -0.15, 0.0, -2.0, 0.0, 0.49)),
}
"""The fallback posture for carrying: the hand level in front of the body, whatever the tilt of
the object."""
_CARRIED_M = ((0.28, 0.20), (0.33, 0.24), (0.26, 0.28), (0.38, 0.20))
"""Candidate hand positions for carrying: forward and sideways from the pelvis."""
_CLEAR_M = (0.16, 0.10, 0.04, -0.04, -0.12)
"""Candidate heights of a carried object's underside above the pelvis, the best first: high enough
to clear a kitchen counter."""
_CARRIED_TURNS = 16
_SLACK_RAD = 0.1
"""Margin that joints keep from their limits while the arm carries something."""


@dataclass(frozen=True, eq=False)
class Held:
    """
    An object in a hand.

    Attributes
    ----------
    object_id, names
        Its id and its names: its class, and its colour and class.
    box
        Its bounding box, in the gripper frame.
    width_m
        The gap of the gripper that holds it.
    gripper
        The rotation (3, 3) of the gripper at the grasp, relative to the heading of the hand.
    below_m
        How far its underside was below the centre of the gripper at the grasp.

    """

    object_id: str
    names: tuple[str, ...]
    box: Obstacle
    width_m: float
    gripper: Array
    below_m: float


class HeldThings(UserDict[str, Held]):
    """
    The held objects, by side.

    Parameters
    ----------
    tell
        Called after each change.

    """

    def __init__(self, tell: Callable[[], None] = lambda: None) -> None:
        super().__init__()
        self._tell = tell

    def __setitem__(self, side: str, held: Held) -> None:
        """Store the object that a hand holds, and notify."""
        super().__setitem__(side, held)
        self._tell()

    def __delitem__(self, side: str) -> None:
        """Mark a hand as empty, and notify."""
        super().__delitem__(side)
        self._tell()

    @property
    def boxes(self) -> dict[str, Obstacle]:
        """Return the bounding boxes of the held objects, each in its gripper frame, by side."""
        return {side: held.box for side, held in self.items()}


def held_objects(
    things: HeldThings, grippers: Mapping[str, str], header: Header
) -> Detection3DArray:
    """
    Create the message that lists the held objects.

    Parameters
    ----------
    things
        The held objects.
    grippers
        The gripper frames, by side: each object is in that of its hand.
    header
        The time, and the frame of the pelvis.

    """
    message = Detection3DArray(header=header)
    for side, held in things.items():
        detection = Detection3D(id=held.object_id)
        detection.header.stamp, detection.header.frame_id = header.stamp, grippers[side]
        for name in held.names:
            result = ObjectHypothesisWithPose()
            result.hypothesis.class_id, result.hypothesis.score = name, 1.0
            detection.results.append(result)
        at, turn = detection.bbox.center.position, detection.bbox.center.orientation
        at.x, at.y, at.z = held.box.middle.position_m.tolist()
        turn.w, turn.x, turn.y, turn.z = quaternion_of(held.box.middle.rotation)
        size = detection.bbox.size
        size.x, size.y, size.z = held.box.size_m
        message.detections.append(detection)
    return message


def carrying(body: UpperBody, side: str, held: Held) -> Reach:
    """
    Find a posture for carrying an object: close to the body, high, and as upright as at the grasp.

    Parameters
    ----------
    body, side
        The upper body, and the side of the hand.
    held
        The held object.

    """
    arm, sign = body.arms[side], 1.0 if side == 'left' else -1.0
    for clear_m in _CLEAR_M:
        found: list[tuple[float, Reach]] = []
        for ahead_m, aside_m in _CARRIED_M:
            at = np.array([ahead_m, sign * aside_m, clear_m + held.below_m])
            for number in range(_CARRIED_TURNS):
                turned = about_z(math.tau * number / _CARRIED_TURNS) @ held.gripper
                reach = body.find_with_arm(side, Frame(at, turned), 0.0, HANGING[side].posture)
                if reach is not None and arm.excess_rad(reach.posture) < -_SLACK_RAD:
                    bent_rad = max(abs(each) for each in reach.posture[1:3])
                    found.append((bent_rad + ahead_m, reach))
        if found:
            return min(found, key=lambda each: each[0])[1]
    return _LEVEL[side]
