# SPDX-License-Identifier: Apache-2.0
"""Candidate poses at which the robot can stand to reach or see a place, in the map plane."""

from __future__ import annotations

from collections.abc import Iterable
import math

from humanoid_perception.places import Places, Point, Room, sides, Surface
from llm_planner.world import base_name

__all__ = ['Pose', 'stands_at_object', 'stands_at_surface', 'stands_in_room']

Pose = tuple[float, float, float]
"""x and y in m, yaw in rad, in the map."""
_APART_M = 0.5
"""Distance from the edge of a piece of furniture to the centre of the robot."""
_CLEAR_M = 0.4
_GRID_M = 0.25
_AROUND = 12
_SIDES = 3


def stands_at_surface(
    surface: Surface, places: Places, towards: Point | None = None
) -> list[Pose]:
    """
    Compute the poses to stand in front of a surface, facing it, best first.

    Parameters
    ----------
    surface
        The surface.
    places
        All places: poses close to other furniture, or outside the room, are excluded.
    towards
        The point on the surface to be close to, in the map (m); by default its centre.

    """
    goal = towards or surface.middle_m
    room = places.room_at(*surface.middle_m)
    poses = []
    for a, b in sides(surface.outline_m):
        length_m = math.dist(a, b)
        if length_m < 0.05:
            continue
        outward = _outward(a, b, surface.middle_m)
        for share in _shares(a, b, goal):
            x = a[0] + share * (b[0] - a[0]) + _APART_M * outward[0]
            y = a[1] + share * (b[1] - a[1]) + _APART_M * outward[1]
            yaw = math.atan2(-outward[1], -outward[0])
            poses.append((x, y, yaw))
    return _sorted_free(poses, goal, places, room, surface.name)


def stands_at_object(position_m: Point, places: Places, distance_m: float = 0.6) -> list[Pose]:
    """
    Compute the poses to stand on a circle around an object on the floor, facing it.

    Parameters
    ----------
    position_m
        The position of the object in the map.
    places
        Furniture and rooms.
    distance_m
        The distance from the object.

    """
    x, y = position_m
    poses = []
    for number in range(_AROUND):
        angle = math.tau * number / _AROUND
        poses.append(
            (
                x + distance_m * math.cos(angle),
                y + distance_m * math.sin(angle),
                math.remainder(angle + math.pi, math.tau),
            )
        )
    return _sorted_free(poses, position_m, places, places.room_at(x, y), '')


def stands_in_room(room: Room, places: Places, at_most: int = 8) -> list[Pose]:
    """
    Compute the poses to stand in a room, facing its centre, closest to the centre first.

    Parameters
    ----------
    room, places
        The room, and the furniture that may be in it.
    at_most
        The maximum number of poses.

    """
    middle = room.middle_m
    xs, ys = zip(*room.outline_m)
    poses = [
        (x, y, math.atan2(middle[1] - y, middle[0] - x) if (x, y) != middle else 0.0)
        for x in _steps(min(xs), max(xs), middle[0])
        for y in _steps(min(ys), max(ys), middle[1])
    ]
    return _sorted_free(poses, middle, places, room.name, '')[:at_most]


def _sorted_free(
    poses: Iterable[Pose], goal: Point, places: Places, room: str, own: str
) -> list[Pose]:
    """Return the poses in the room that are clear of furniture, closest to a goal first."""
    others = [each for each in places.surfaces if base_name(each.name) != base_name(own)]
    free = [
        pose
        for pose in poses
        if (not room or places.room_at(pose[0], pose[1]) == room)
        and all(each.distance_m((pose[0], pose[1])) > _CLEAR_M for each in others)
    ]
    return sorted(free, key=lambda pose: math.dist(pose[:2], goal))


def _outward(a: Point, b: Point, middle: Point) -> Point:
    """Compute the unit normal of a side that points away from the centre of the outline."""
    length_m = math.dist(a, b)
    normal = ((b[1] - a[1]) / length_m, (a[0] - b[0]) / length_m)
    is_inward = (middle[0] - a[0]) * normal[0] + (middle[1] - a[1]) * normal[1] > 0.0
    return (-normal[0], -normal[1]) if is_inward else normal


def _shares(a: Point, b: Point, goal: Point) -> list[float]:
    """Return the fractions of a side to stand at: closest to a goal, the middle, the quarters."""
    length2 = math.dist(a, b) ** 2
    nearest = ((goal[0] - a[0]) * (b[0] - a[0]) + (goal[1] - a[1]) * (b[1] - a[1])) / length2
    return [max(0.1, min(0.9, nearest)), 0.5, 0.25, 0.75][: _SIDES + 1]


def _steps(low: float, high: float, through: float) -> list[float]:
    count = int((high - low) / _GRID_M) + 1
    return [through + step * _GRID_M for step in range(-count, count + 1)]
