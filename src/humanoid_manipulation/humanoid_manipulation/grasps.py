# SPDX-License-Identifier: Apache-2.0
"""How a thing can be grasped, from its shape and size: from the side and from above."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_control.dynamics.rotations import about_z
from humanoid_description.robot import Array
import numpy as np

__all__ = ['Grasp', 'Graspable', 'Hand', 'grasps_of']

ROUND = frozenset(('apple', 'ball', 'bottle', 'bowl', 'can', 'cup', 'mug', 'orange'))
"""Classes of things that look the same from all sides: any side of them can be grasped."""
BALLS = frozenset(('apple', 'ball', 'orange'))
"""Of these, classes that are as round from above: the corners of their boxes are empty."""
HANDLED = frozenset(('cup', 'mug'))
"""Classes of things with a handle, which is seen as a part of their width."""
_BODY = 0.85
"""Of its height, by which the body of such a thing is not wider."""
_AROUND, _ABOVE = 16, 8
"""From how many sides, and in how many turns from above, a round thing is grasped."""
_APPROACH_M = 0.10
_LEAST_MARGIN_M, _MARGIN_M = 0.006, 0.020
"""How much wider than the thing the gripper must open, and opens if it can, on each side."""
_LOOKS_WIDER_M = 0.025
"""How much wider than it is a thing may be remembered that was seen from afar."""
_ABOVE_M = 0.010
"""How high above what a thing stands on the fingers stay."""
_PALM_M = 0.005
"""Between the palm and the thing."""
_ROLLS_M = 0.005
"""How much more for what rolls away when it is touched."""
_TILTS_RAD = (0.0, 0.4, 0.8)
"""How far a hand from the side points down: a level arm does not get to what is low."""
_INSIDE_M, _HANGS_M = 0.03, 0.05
"""How deep a hand from above holds what is tall, and how far its middle may hang below: fingers
do not keep what is taller from swinging."""


@dataclass(frozen=True)
class Hand:
    """
    The size of a gripper.

    Attributes
    ----------
    widest_m
        The gap between its fingers when it is open.
    palm_m, tip_m
        How far the palm and the finger tips are from the middle of the grip.
    finger_m
        How wide a finger is, across the hand.

    """

    widest_m: float = 0.10
    palm_m: float = 0.0425
    tip_m: float = 0.0325
    finger_m: float = 0.024


@dataclass(frozen=True, eq=False)
class Graspable:
    """
    A thing that stands on something.

    Attributes
    ----------
    class_id
        What it is.
    position_m, size_m, yaw_rad
        Its upright box: middle (3,), edges (3,), and heading.

    """

    class_id: str
    position_m: Array
    size_m: Array
    yaw_rad: float = 0.0

    @property
    def is_round(self) -> bool:
        """Whether any side of it can be grasped alike."""
        return self.class_id in ROUND

    @property
    def bottom_m(self) -> float:
        """Return the height of its underside."""
        return float(self.position_m[2] - 0.5 * self.size_m[2])


@dataclass(frozen=True, eq=False)
class Grasp:
    """
    A way to take hold of a thing.

    Attributes
    ----------
    gripper
        Where the gripper closes, or opens.
    gap_m, width_m
        How far the gripper opens before, and how far it is open when it holds the thing.
    from_above
        Whether the hand points down.
    lowers_m
        Of a thing that is put down: from how far above the hand comes, instead of along itself.

    """

    gripper: Frame
    gap_m: float
    width_m: float
    from_above: bool = False
    lowers_m: float = 0.0

    @property
    def is_lifted(self) -> bool:
        """Whether a thing is taken, and not put down."""
        return not self.lowers_m

    @property
    def approach_m(self) -> Array:
        """Return the way (3,) from the gripper to where the hand is before."""
        if self.lowers_m:
            return np.array([0.0, 0.0, self.lowers_m])
        return _APPROACH_M * self.gripper.rotation[:, 2]


def grasps_of(thing: Graspable, hand: Hand = Hand()) -> Iterator[Grasp]:
    """
    Yield the ways to take hold of a thing, those from the side first.

    Parameters
    ----------
    thing
        What is to be grasped.
    hand
        What it is grasped with.

    Returns
    -------
    Iterator of Grasp
        In the frame of the thing's position. There are none if it is too wide for the hand.

    """
    for heading_rad, width_m, depth_m in _sides(thing, hand):
        gap_m = min(width_m + 2.0 * _MARGIN_M, hand.widest_m)
        for tilt_rad in _TILTS_RAD:
            sine, cosine = math.sin(tilt_rad), math.cos(tilt_rad)
            level = np.array([math.cos(heading_rad), math.sin(heading_rad), 0.0])
            below_m = hand.tip_m * sine + 0.5 * hand.finger_m * cosine + _ABOVE_M
            height_m = max(float(thing.position_m[2]), thing.bottom_m + below_m)
            above_m = thing.bottom_m + float(thing.size_m[2]) - height_m
            # The hand stays so far back that the palm does not touch the near edge of the top.
            if thing.class_id in BALLS:
                near_m = 0.5 * depth_m + _ROLLS_M
            else:
                near_m = 0.5 * depth_m * cosine + above_m * sine
            back_m = near_m - hand.palm_m + _PALM_M
            if above_m > 0.0 and not (thing.is_round and back_m > hand.tip_m - _PALM_M):
                ahead = cosine * level - np.array([0.0, 0.0, sine])
                position = np.array([*thing.position_m[:2], height_m])
                position -= max(back_m, 0.0) * ahead
                yield Grasp(Frame(position, _pointing(ahead)), gap_m, width_m)
    top_m = thing.bottom_m + float(thing.size_m[2])
    height_m = max(
        top_m - min(_INSIDE_M, 0.5 * float(thing.size_m[2])),
        thing.bottom_m + hand.tip_m + 0.005,
    )
    if height_m - float(thing.position_m[2]) > _HANGS_M:
        return
    for heading_rad, width_m, _ in _sides(thing, hand, _ABOVE):
        gap_m = min(width_m + 2.0 * _MARGIN_M, hand.widest_m)
        position = np.array([*thing.position_m[:2], height_m])
        yield Grasp(Frame(position, about_z(heading_rad)), gap_m, width_m, from_above=True)


def _sides(
    thing: Graspable, hand: Hand, around: int = _AROUND
) -> Iterator[tuple[float, float, float]]:
    """Yield directions to come from where the hand is wide enough: heading, width and depth."""
    most_m = hand.widest_m - 2.0 * _LEAST_MARGIN_M
    length, width, height = thing.size_m.tolist()
    if thing.is_round:
        # A handle, or what is seen of another thing, makes a round thing longer than it is.
        across = min(length, width)
        if thing.class_id in HANDLED:
            across = min(across, _BODY * height)
        if across <= most_m + _LOOKS_WIDER_M:
            for number in range(around):
                yield math.tau * number / around, min(across, most_m), across
        return
    for number in range(4):
        turned = number % 2 == 1
        heading = thing.yaw_rad + number * math.pi / 2.0
        across, deep = (length, width) if turned else (width, length)
        if across <= most_m + _LOOKS_WIDER_M:
            yield heading, min(across, most_m), deep


def _pointing(ahead: Array) -> Array:
    """Return the rotation of a hand that points somewhere, its fingers side by side."""
    aside = np.array([-ahead[1], ahead[0], 0.0])
    aside /= np.linalg.norm(aside)
    return np.stack((np.cross(aside, -ahead), aside, -ahead), axis=1)
