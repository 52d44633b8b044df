# SPDX-License-Identifier: Apache-2.0
"""Generate grasps of an object from its shape and size: from the side and from above."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.robot import Array
from humanoid_description.rotations import about_z
import numpy as np

__all__ = ['Grasp', 'Graspable', 'Hand', 'grasps_of']

ROUND = frozenset(('apple', 'ball', 'bottle', 'bowl', 'can', 'cup', 'mug', 'orange'))
"""Classes of rotationally symmetric objects, which can be grasped from any side."""
BALLS = frozenset(('apple', 'ball', 'orange'))
"""Those of them that are spherical: the corners of their boxes are empty."""
HANDLED = frozenset(('cup', 'mug'))
"""Classes of objects with a handle, which is detected as a part of their width."""
_BODY = 0.85
"""Largest width of the body of such an object, as a fraction of its height."""
_AROUND, _ABOVE = 16, 8
"""Number of headings from the side, and of those from above, for a symmetric object."""
_APPROACH_M = 0.10
_LEAST_MARGIN_M, _MARGIN_M = 0.006, 0.020
"""Least and preferred clearance between the object and the open gripper, on each side."""
_LOOKS_WIDER_M = 0.025
"""By how much the width of an object seen from afar may be overestimated."""
_ABOVE_M = 0.010
"""Clearance between the fingers and the surface below the object."""
_PALM_M = 0.005
"""Clearance between the palm and the object."""
_ROLLS_M = 0.005
"""Additional clearance for a ball, which rolls away when touched."""
_TILTS_RAD = (0.0, 0.4, 0.8)
"""Downward tilts of a hand that comes from the side: a level arm does not reach low objects."""
_INSIDE_M, _HANGS_M = 0.03, 0.05
"""How far below its top a hand from above grasps a tall object, and how far the object's centre
may hang below the grasp: the fingers do not keep a taller object from swinging."""


@dataclass(frozen=True)
class Hand:
    """
    The dimensions of a gripper.

    Attributes
    ----------
    widest_m
        The largest gap between its fingers.
    palm_m, tip_m
        The distances of the palm and the fingertips from the centre of the grip.
    finger_m
        The width of a finger, across the hand.

    """

    widest_m: float = 0.10
    palm_m: float = 0.0425
    tip_m: float = 0.0325
    finger_m: float = 0.024


@dataclass(frozen=True, eq=False)
class Graspable:
    """
    An object that stands on a surface.

    Attributes
    ----------
    class_id
        Its class.
    position_m, size_m, yaw_rad
        Its upright bounding box: centre (3,), edge lengths (3,), and yaw.

    """

    class_id: str
    position_m: Array
    size_m: Array
    yaw_rad: float = 0.0

    @property
    def is_round(self) -> bool:
        """Whether the object is rotationally symmetric: it can be grasped from any side."""
        return self.class_id in ROUND

    @property
    def bottom_m(self) -> float:
        """Return the height of the underside of the object."""
        return float(self.position_m[2] - 0.5 * self.size_m[2])


@dataclass(frozen=True, eq=False)
class Grasp:
    """
    A grasp of an object, or the release of a placed one.

    Attributes
    ----------
    gripper
        The pose of the gripper at which it closes, or opens.
    gap_m, width_m
        The gap to which the gripper opens for the approach, and the gap at which it holds the
        object.
    from_above
        Whether the hand points down.
    lowers_m
        For a placed object: the height from which the hand is lowered vertically; 0 for a grasp,
        which is approached along the hand.

    """

    gripper: Frame
    gap_m: float
    width_m: float
    from_above: bool = False
    lowers_m: float = 0.0

    @property
    def is_lifted(self) -> bool:
        """Whether the object is picked up, rather than placed."""
        return not self.lowers_m

    @property
    def approach_m(self) -> Array:
        """Return the displacement (3,) from the grasp to the pre-grasp position."""
        if self.lowers_m:
            return np.array([0.0, 0.0, self.lowers_m])
        return _APPROACH_M * self.gripper.rotation[:, 2]


def grasps_of(thing: Graspable, hand: Hand = Hand()) -> Iterator[Grasp]:
    """
    Yield candidate grasps of an object, those from the side first.

    Parameters
    ----------
    thing
        The object.
    hand
        The gripper.

    Returns
    -------
    Iterator of Grasp
        Grasps in the frame of the object's position; none if it is too wide for the hand.

    """
    for heading_rad, width_m, depth_m in _sides(thing, hand):
        gap_m = min(width_m + 2.0 * _MARGIN_M, hand.widest_m)
        for tilt_rad in _TILTS_RAD:
            sine, cosine = math.sin(tilt_rad), math.cos(tilt_rad)
            level = np.array([math.cos(heading_rad), math.sin(heading_rad), 0.0])
            below_m = hand.tip_m * sine + 0.5 * hand.finger_m * cosine + _ABOVE_M
            height_m = max(float(thing.position_m[2]), thing.bottom_m + below_m)
            above_m = thing.bottom_m + float(thing.size_m[2]) - height_m
            # The hand stays far enough back for the palm to clear the near edge of the top.
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
    """Yield the approach headings for which the hand is wide enough, with width and depth."""
    most_m = hand.widest_m - 2.0 * _LEAST_MARGIN_M
    length, width, height = thing.size_m.tolist()
    if thing.is_round:
        # A handle, or pixels of another object, make a symmetric object appear longer than it is.
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
    """Compute the rotation of a hand that points in a direction, its fingers side by side."""
    aside = np.array([-ahead[1], ahead[0], 0.0])
    aside /= np.linalg.norm(aside)
    return np.stack((np.cross(aside, -ahead), aside, -ahead), axis=1)
