# SPDX-License-Identifier: Apache-2.0
"""Stance selection: where to stand and how to bend so that a hand reaches a grasp."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.drives import SIDES
from humanoid_description.robot import Array
from humanoid_description.rotations import about_y, about_z
from humanoid_manipulation.free_floor import FreeFloor, NAVIGABLE_M
from humanoid_manipulation.grasps import Grasp
from humanoid_manipulation.upper_body import Reach, UpperBody
from humanoid_perception.places import Places
import numpy as np

__all__ = [
    'BENDS',
    'LIFT_M',
    'Bend',
    'Stance',
    'base_of',
    'effort',
    'grasp_reaches',
    'stances_for',
]

_HEIGHT_M = 0.68
"""Height of the pelvis of a robot that stands upright."""
_BACK_M, _BACK_M_RAD = 0.007, 0.145
"""How far the pelvis is behind the midpoint of the soles, and how far it moves back per radian of
its pitch, to keep the weight above the feet."""
_RISE_M_RAD2 = 0.1
_AHEAD_M = (0.34, 0.40, 0.46, 0.52, 0.58, 0.64)
_ASIDE_M = (0.12, 0.20, 0.28)
_HEADINGS = 16
_EDGE_M = 0.20
"""Smallest distance from the midpoint of the feet to the edge of furniture."""
_LEAST_ROOM_M = 0.18
"""Smallest distance from the midpoint of the feet to mapped obstacles."""
_BACK_OFF_M = 0.40
"""Distance behind the stance at which navigation ends and stepping starts."""
_WIDE_M, _NARROW_COST_1_M = 0.55, 2.0
"""Distance from mapped obstacles below which navigation does not work well, and the cost per
metre below it."""
_SQUEEZE_COST = 3.0
"""Cost of a stance to which no path is wide throughout."""
_ARM_M, _ARM_EDGE_M = 0.25, 0.15
"""Sideways offset of a hanging arm, and its smallest distance from furniture."""
_LEAST_COSINE = 0.5
"""Smallest cosine of the angle between the heading of the robot and the direction of the hand."""
_MOST_JUMP_RAD = 1.2
"""A joint that turns farther during the approach has switched to another IK solution."""
LIFT_M = np.array([0.0, 0.0, 0.06])
"""Displacement (3,) that lifts an object from its surface."""
_UPRIGHT_COST = 0.6
"""Cost of bending by a radian, in radians of the joints of an arm."""


@dataclass(frozen=True)
class Bend:
    """A body posture: the pitch (rad) and height (m) of `body_pose`."""

    pitch_rad: float = 0.0
    height_m: float = 0.0


BENDS = (
    Bend(),
    Bend(0.25, -0.03),
    Bend(0.5, -0.03),
    Bend(0.25, -0.12),
    Bend(0.5, -0.12),
)
"""The bends that are tried, from upright to deep."""


@dataclass(frozen=True, eq=False)
class Stance:
    """
    A place to stand from which a hand reaches a grasp.

    Attributes
    ----------
    x_m, y_m, yaw_rad
        The midpoint of the soles in the map, and the heading of the robot.
    bend
        The bend of the body.
    side
        The side of the hand.
    grasp
        The grasp, in the map.
    cost
        The cost; lower is better.

    """

    x_m: float
    y_m: float
    yaw_rad: float
    bend: Bend
    side: str
    grasp: Grasp
    cost: float

    @property
    def before(self) -> tuple[float, float, float]:
        """Where navigation ends and stepping starts: x and y in m, and the heading in rad."""
        return *_before(self.x_m, self.y_m, self.yaw_rad), self.yaw_rad


def base_of(x_m: float, y_m: float, yaw_rad: float, bend: Bend) -> Frame:
    """
    Predict the pose of the pelvis in the map, to within a centimetre or two.

    Parameters
    ----------
    x_m, y_m, yaw_rad
        Where the robot stands: the midpoint of its feet, and its heading.
    bend
        The bend of the body.

    """
    heading = about_z(yaw_rad)
    back = -_BACK_M - _BACK_M_RAD * bend.pitch_rad
    height = _HEIGHT_M + bend.height_m + _RISE_M_RAD2 * bend.pitch_rad**2
    position = np.array([x_m, y_m, 0.0]) + heading @ np.array([back, 0.0, height])
    return Frame(position, heading @ about_y(bend.pitch_rad))


def grasp_reaches(
    body: UpperBody,
    side: str,
    grasp: Grasp,
    base: Frame,
    near: Reach | None = None,
    turns: Iterable[float] = (0.0,),
) -> tuple[Reach, Reach] | None:
    """
    Solve the inverse kinematics of a grasp: the pre-grasp and the grasp posture.

    Returns None if either is out of reach, or if the object could not be lifted from there.

    Parameters
    ----------
    body, side
        The upper body, and the side of the hand.
    grasp, base
        The grasp, and the pose of the pelvis, in the same frame.
    near
        The current posture of the arm.
    turns
        The waist angles to try, in rad.

    """
    gripper = grasp.gripper.seen_from(base)
    before = Frame(gripper.position_m + base.rotation.T @ grasp.approach_m, gripper.rotation)
    for waist_rad in turns:
        last = body.find_with_arm(side, gripper, waist_rad, near.posture if near else None)
        if last is None:
            continue
        first = body.find_with_arm(side, before, waist_rad, last.posture)
        if first is None:
            continue
        if _jump_rad(first, last) > _MOST_JUMP_RAD:
            continue
        if grasp.is_lifted:
            above = Frame(gripper.position_m + base.rotation.T @ LIFT_M, gripper.rotation)
            lifted = body.find_with_arm(side, above, waist_rad, last.posture)
            if lifted is None or _jump_rad(last, lifted) > _MOST_JUMP_RAD:
                continue
        return first, last
    return None


def _jump_rad(one: Reach, other: Reach) -> float:
    """Compute the largest joint displacement of an arm between two postures."""
    return max(abs(a - b) for a, b in zip(one.posture, other.posture))


def effort(
    body: UpperBody, grasp: Grasp, reached: Sequence[Reach], side: str, bend: Bend
) -> float:
    """
    Compute the cost of a grasp: lower is better.

    Parameters
    ----------
    body, side, bend
        The upper body, the side of the hand, and the bend of the body.
    grasp, reached
        The grasp, and its pre-grasp and grasp postures.

    """
    # Joints near their limits leave no room for corrections.
    arm = body.arms[side]
    slack_rad = min(-arm.excess_rad(each.posture) for each in reached)
    posture = 1.0 - 2.0 * min(slack_rad, 0.3) + 0.5 * abs(reached[-1].waist_rad)
    bent = _UPRIGHT_COST * bend.pitch_rad - 2.0 * bend.height_m
    return posture + bent + 0.4 * grasp.from_above


def stances_for(
    body: UpperBody,
    grasps: Sequence[Grasp],
    position_m: Array,
    places: Places,
    near_m: tuple[float, float] | None = None,
    sides: Sequence[str] = SIDES,
    at_most: int = 6,
    floor: FreeFloor | None = None,
) -> list[Stance]:
    """
    Find stances from which an object can be grasped, the best first.

    Parameters
    ----------
    body
        The upper body.
    grasps
        The candidate grasps, in the map.
    position_m
        The position of the object in the map (3,).
    places
        The surfaces that block the floor, and the rooms: the robot stands in the object's room.
    near_m
        The position of the robot; a nearer stance has a lower cost.
    sides
        The sides of the hands that may be used.
    at_most
        The maximum number of stances.
    floor
        The free floor; without it, all floor outside the surfaces is free.

    """
    found: list[Stance] = []
    for x_m, y_m, yaw_rad, side in _stands(position_m, places):
        if side not in sides or (floor and floor.room_m((x_m, y_m)) < _LEAST_ROOM_M):
            continue
        before = _before(x_m, y_m, yaw_rad)
        before_m = floor.room_m(before) if floor else math.inf
        if before_m < NAVIGABLE_M:
            continue
        for bend in BENDS:
            best = _best(body, side, grasps, base_of(x_m, y_m, yaw_rad, bend), bend)
            if best is None:
                continue
            cost, grasp = best
            cost += _NARROW_COST_1_M * max(0.0, _WIDE_M - before_m)
            if near_m is not None:
                cost += 0.6 * math.dist(near_m, (x_m, y_m))
                if floor and not floor.is_wide_way(near_m, before):
                    cost += _SQUEEZE_COST
            found.append(Stance(x_m, y_m, yaw_rad, bend, side, grasp, cost))
            break
    return _apart(sorted(found, key=lambda stance: stance.cost), at_most)


def _before(x_m: float, y_m: float, yaw_rad: float) -> tuple[float, float]:
    """Compute the point behind a stance at which navigation ends, clear of the furniture."""
    return x_m - _BACK_OFF_M * math.cos(yaw_rad), y_m - _BACK_OFF_M * math.sin(yaw_rad)


def _stands(position_m: Array, places: Places) -> Iterator[tuple[float, float, float, str]]:
    """Yield candidate stances with an object in front of one shoulder: x, y, yaw and side."""
    room = places.room_at(float(position_m[0]), float(position_m[1]))
    for number in range(_HEADINGS):
        yaw_rad = math.tau * number / _HEADINGS - math.pi
        c, s = math.cos(yaw_rad), math.sin(yaw_rad)
        for ahead in _AHEAD_M:
            for aside in _ASIDE_M:
                for side in SIDES:
                    left = aside if side == 'left' else -aside
                    x_m = float(position_m[0]) - c * ahead + s * left
                    y_m = float(position_m[1]) - s * ahead - c * left
                    if room and places.room_at(x_m, y_m) != room:
                        continue
                    if _is_free(places, x_m, y_m, yaw_rad):
                        yield x_m, y_m, yaw_rad, side


def _is_free(places: Places, x_m: float, y_m: float, yaw_rad: float) -> bool:
    """Check whether the robot can stand at a pose with hanging arms, clear of furniture."""
    aside = (-_ARM_M * math.sin(yaw_rad), _ARM_M * math.cos(yaw_rad))
    arms = [(x_m + sign * aside[0], y_m + sign * aside[1]) for sign in (1.0, -1.0)]
    return all(
        each.distance_m((x_m, y_m)) >= _EDGE_M
        and all(each.distance_m(arm) >= _ARM_EDGE_M for arm in arms)
        for each in places.surfaces
    )


def _best(
    body: UpperBody, side: str, grasps: Iterable[Grasp], base: Frame, bend: Bend
) -> tuple[float, Grasp] | None:
    """Find the grasp with the lowest cost from a pose of the pelvis; return cost and grasp."""
    best: tuple[float, Grasp] | None = None
    for grasp in grasps:
        if not _is_ahead(grasp, base):
            continue
        reached = grasp_reaches(body, side, grasp, base)
        if reached is None:
            continue
        cost = effort(body, grasp, reached, side, bend)
        if best is None or cost < best[0]:
            best = cost, grasp
    return best


def _is_ahead(grasp: Grasp, base: Frame) -> bool:
    """Check whether a grasp is approached roughly from the robot's side, or from above."""
    ahead = float(-grasp.gripper.rotation[:, 2] @ base.rotation[:, 0])
    return grasp.from_above or ahead > _LEAST_COSINE


def _apart(stances: Sequence[Stance], at_most: int) -> list[Stance]:
    """Drop stances that are near a better one, and limit their number."""
    kept: list[Stance] = []
    for each in stances:
        if all(math.dist((each.x_m, each.y_m), (o.x_m, o.y_m)) > 0.15 for o in kept):
            kept.append(each)
        if len(kept) == at_most:
            break
    return kept
