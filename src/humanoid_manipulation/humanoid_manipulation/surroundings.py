# SPDX-License-Identifier: Apache-2.0
"""The surroundings of the robot: surfaces from the places file, and remembered objects."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
import math

from humanoid_common.qos import LATCHED, STATE
from humanoid_common.single_goal import RunningGoal
from humanoid_control.dynamics.frames import Frame
from humanoid_description.robot import Array
from humanoid_description.rotations import about_z, from_quaternion, yaw_of
from humanoid_manipulation.free_floor import FreeFloor
from humanoid_manipulation.grasps import Graspable
from humanoid_manipulation.obstacle import Obstacle
from humanoid_perception.places import Outline, Places, Surface
from humanoid_perception.places_file import load_places, places_path
from humanoid_perception.transforms import Transforms
from nav_msgs.msg import OccupancyGrid
import numpy as np
from rclpy.node import Node
from vision_msgs.msg import Detection3D, Detection3DArray

__all__ = ['Remembered', 'Surroundings', 'surface_boxes']

_FAR_M = 1.5
"""Obstacles farther from the robot are ignored."""
_MOVED_M = 0.12
"""A detection farther from a remembered object belongs to another one."""
_PERSON, _PERSON_M = 'person', 0.25
"""The class that blocks floor space, and its radius."""
_BOARD_M = 0.03
"""The least thickness of a surface."""


@dataclass(frozen=True, eq=False)
class Remembered:
    """
    An object that the robot remembers.

    Attributes
    ----------
    object_id, names
        Its id and its names: its class, and its colour and class.
    graspable
        Its class and its bounding box, in the frame of the object memory.

    """

    object_id: str
    names: tuple[str, ...]
    graspable: Graspable

    @property
    def name(self) -> str:
        """Return the name of the object in messages."""
        return self.object_id.replace('_', ' ')

    @property
    def rotation(self) -> Array:
        """Return the rotation of the bounding box (3, 3)."""
        return about_z(self.graspable.yaw_rad)


class Surroundings:
    """
    Obstacle model for the arms: surfaces, remembered objects and the floor.

    Parameters
    ----------
    node
        The node that subscribes to `objects`, `detections_3d` and `map`.
    transforms
        The transform listener.
    base_frame
        The frame of the pelvis, in which obstacles are returned.
    places_file
        The file of named places; empty for none.

    Raises
    ------
    UserError
        The file of named places cannot be used.

    """

    def __init__(
        self, node: Node, transforms: Transforms, base_frame: str, places_file: str
    ) -> None:
        self._node, self._transforms, self._base = node, transforms, base_frame
        self._detections: list[Detection3DArray] = []
        self._objects = Detection3DArray()
        path = places_path(places_file)
        self.places = load_places(path) if path else Places()
        self._map = OccupancyGrid()
        self._floor: FreeFloor | None = None
        node.create_subscription(Detection3DArray, 'objects', self._take, LATCHED)
        node.create_subscription(OccupancyGrid, 'map', self._take_map, LATCHED)

    async def obstacles(
        self, goal: RunningGoal, wider_m: float = 0.0, exact: str = ''
    ) -> list[Obstacle]:
        """
        List the obstacles near the robot, in the pelvis frame.

        Parameters
        ----------
        goal
            The goal.
        wider_m
            The padding of objects on each side: they are known less exactly than surfaces.
        exact
            The name of an object that is not padded.

        """
        found: list[Obstacle] = []
        if self.places.surfaces:
            pose = await self._transforms.known(goal, self._base, self.places.frame)
            for surface in self.places.surfaces:
                found += _near(surface_boxes(surface), pose)
        if self._objects.detections:
            pose = await self._transforms.known(goal, self._base, self.frame)
            boxes = [
                Obstacle(
                    each.name,
                    Frame(each.graspable.position_m, each.rotation),
                    _widened(each, wider_m if each.name != exact else 0.0),
                )
                for each in self.things()
            ]
            found += _near(boxes, pose)
        return found

    @property
    def frame(self) -> str:
        """Return the frame of the remembered objects."""
        return self._objects.header.frame_id or self.places.frame

    def things(self, asked: str = '') -> list[Remembered]:
        """
        Find the remembered objects with an id, a class, or a colour and class.

        Parameters
        ----------
        asked
            Such as `red_mug_1`, `mug` or `red mug`; empty for all objects.

        Returns
        -------
        list of Remembered
            The matching objects, in the frame `frame`.

        """
        wanted = asked.replace('_', ' ').strip().lower()
        found = [_remembered(each) for each in self._objects.detections]
        return [
            each
            for each in found
            if not asked or each.object_id == asked or wanted in (each.name, *each.names)
        ]

    @property
    def floor(self) -> FreeFloor:
        """Return the free floor of the map, with remembered people as obstacles."""
        if self._floor is None:
            known = self._map.header.frame_id == self.frame
            people = (each for each in self.things(_PERSON) if known)
            self._floor = FreeFloor(
                self._map if known else OccupancyGrid(),
                [(*each.graspable.position_m[:2].tolist(), _PERSON_M) for each in people],
            )
        return self._floor

    @contextmanager
    def watching(self) -> Iterator[None]:
        """Collect the detections of the enclosed block."""
        self._detections = []
        subscription = self._node.create_subscription(
            Detection3DArray, 'detections_3d', self._detections.append, STATE
        )
        try:
            yield
        finally:
            self._node.destroy_subscription(subscription)

    def seen(self, thing: Remembered) -> list[Array]:
        """
        Collect the positions at which an object was detected since `watching` was entered.

        Parameters
        ----------
        thing
            The object: detections of its class that are within 0.12 m count.

        Returns
        -------
        list of Array
            Positions (3,) in m in the frame `frame`, at most one per message.

        Raises
        ------
        GoalAborted
            The pose of the camera is not known.

        """
        found = []
        for message in self._detections:
            pose = self._transforms.pose(self.frame, message.header.frame_id)
            places = [
                pose[:3, :3] @ each.graspable.position_m + pose[:3, 3]
                for each in map(_remembered, message.detections)
                if each.names[:1] == thing.names[:1]
            ]
            away_m = [float(np.linalg.norm(at - thing.graspable.position_m)) for at in places]
            if away_m and min(away_m) < _MOVED_M:
                found.append(places[int(np.argmin(away_m))])
        return found

    def corrected(self, thing: Remembered) -> Remembered:
        """
        Correct the position of an object by the median of its detections: see `seen`.

        Parameters
        ----------
        thing
            The object as it is remembered.

        Returns
        -------
        Remembered
            The object at the new x and y and the remembered z, which is more accurate; unchanged
            if it was not detected.

        Raises
        ------
        GoalAborted
            As for `seen`.

        """
        seen = self.seen(thing)
        if not seen:
            return thing
        position = np.median(seen, axis=0)
        position[2] = thing.graspable.position_m[2]
        return replace(thing, graspable=replace(thing.graspable, position_m=position))

    def _take(self, message: Detection3DArray) -> None:
        self._objects, self._floor = message, None

    def _take_map(self, message: OccupancyGrid) -> None:
        self._map, self._floor = message, None


def _widened(thing: Remembered, wider_m: float) -> tuple[float, float, float]:
    """Pad the edges of an object's bounding box on each side."""
    length, width, height = (thing.graspable.size_m + 2.0 * wider_m).tolist()
    return length, width, height


def surface_boxes(surface: Surface) -> list[Obstacle]:
    """
    Approximate a surface by boxes: a board, or a block down to the floor, and its fixtures.

    The legs of a table are unknown. An arm that comes from above does not reach them.

    Parameters
    ----------
    surface
        The surface, in the map.

    Returns
    -------
    list of Obstacle
        The boxes, in the map.

    """
    name, top_m = surface.name.replace('_', ' '), surface.height_m
    boxes = [_block(name, surface.outline_m, top_m, surface.depth_m or max(top_m, _BOARD_M))]
    return boxes + [
        _block(f'what stands on {name}', each.outline_m, top_m + each.height_m, each.height_m)
        for each in surface.fixtures
    ]


def _block(name: str, outline_m: Outline, top_m: float, depth_m: float) -> Obstacle:
    """Compute the bounding box of an outline, aligned with its longest edge."""
    outline = np.array(outline_m)
    edges = np.roll(outline, -1, axis=0) - outline
    longest = edges[int(np.argmax((edges**2).sum(axis=1)))]
    yaw_rad = math.atan2(longest[1], longest[0])
    turn = about_z(yaw_rad)
    across = outline @ turn[:2, :2]
    lower, upper = across.min(axis=0), across.max(axis=0)
    middle = turn[:2, :2] @ ((lower + upper) / 2.0)
    size = (float(upper[0] - lower[0]), float(upper[1] - lower[1]), depth_m)
    position = np.array([*middle, top_m - depth_m / 2.0])
    return Obstacle(name, Frame(position, turn), size)


def _remembered(detection: Detection3D) -> Remembered:
    """Convert a detection message to a remembered object."""
    at, turn, size = (
        detection.bbox.center.position,
        detection.bbox.center.orientation,
        detection.bbox.size,
    )
    names = tuple(each.hypothesis.class_id for each in detection.results)
    return Remembered(
        detection.id,
        names,
        Graspable(
            names[0] if names else '',
            np.array([at.x, at.y, at.z]),
            np.array([size.x, size.y, size.z]),
            yaw_of(from_quaternion((turn.w, turn.x, turn.y, turn.z))),
        ),
    )


def _near(obstacles: Iterable[Obstacle], pose: Array) -> list[Obstacle]:
    """Transform obstacles by `pose` (4, 4) to another frame; drop those far from its origin."""
    found = []
    for each in obstacles:
        position = pose[:3, :3] @ each.middle.position_m + pose[:3, 3]
        reach_m = 0.5 * math.hypot(*each.size_m[:2]) + _FAR_M
        if float(np.linalg.norm(position[:2])) < reach_m:
            middle = Frame(position, pose[:3, :3] @ each.middle.rotation)
            found.append(Obstacle(each.name, middle, each.size_m))
    return found
