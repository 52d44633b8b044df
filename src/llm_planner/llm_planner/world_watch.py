# SPDX-License-Identifier: Apache-2.0
"""Observation of the world: remembered objects, running servers, and the pose of the robot."""

from __future__ import annotations

from typing import Any

from humanoid_common.inhibition import Inhibition
from humanoid_common.qos import LATCHED
from humanoid_perception.memory_conversions import planar_of, pose_of
from humanoid_perception.places import Places, Room, Surface
from humanoid_perception.sighting import greatest_sigma_m
from llm_planner.skills import Skill, Skills
from llm_planner.world import base_name, KnownObject, World
import numpy as np
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import String
from tf2_ros import Buffer, TransformException, TransformListener
from vision_msgs.msg import Detection3DArray

__all__ = ['WorldWatch']

_MAP, _BASE = 'map', 'base_footprint'
_ARM = ('shoulder', 'shoulder_roll', 'shoulder_yaw', 'elbow')
_WRIST = ('wrist_yaw', 'wrist_pitch')
"""Further joints of an arm with a hand."""


class WorldWatch:
    """
    Observer of the world for the planner.

    Parameters
    ----------
    node
        The node that subscribes.
    skills, places
        The skills, and the named places.
    implemented
        The names of the implemented skills.

    """

    def __init__(
        self, node: Node, skills: Skills, places: Places, implemented: frozenset[str]
    ) -> None:
        self._node, self._skills, self._implemented = node, skills, implemented
        self.places = places
        self._things: tuple[KnownObject, ...] = ()
        self._held: dict[str, str] = {}
        self._inhibition = Inhibition()
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, node)
        self._model = ''
        node.create_subscription(Detection3DArray, 'objects', self._take, LATCHED)
        node.create_subscription(Detection3DArray, 'held_objects', self._take_held, LATCHED)
        node.create_subscription(String, 'robot_description', self._take_model, LATCHED)
        for topic, tell in (
            ('walking_state', self._inhibition.tell_walking_state),
            ('stop_state', self._inhibition.tell_stop_state),
        ):
            node.create_subscription(
                String, topic, lambda message, tell=tell: tell(message.data), LATCHED
            )
        rooms = {each.name for each in places.rooms}
        self._surfaces = {
            base_name(each.name): places.room_at(*each.middle_m) for each in places.surfaces
        }
        self._rooms = tuple(sorted(rooms))

    @property
    def things(self) -> tuple[KnownObject, ...]:
        """Return the remembered objects."""
        return self._things

    @property
    def holding(self) -> str:
        """Return the name of the held object; empty if there is none."""
        return next(iter(self._held.values()), '')

    def held_by(self, side: str) -> str:
        """
        Look up the object that a hand holds.

        Parameters
        ----------
        side
            `left` or `right`.

        Returns
        -------
        str
            The name of the object, such as `red mug`; empty if there is none.

        """
        return self._held.get(side, '')

    @property
    def inhibition(self) -> str:
        """Return the reason why the robot cannot walk now; empty if it can."""
        return self._inhibition.reason

    def arm_joints(self, side: str) -> list[str]:
        """
        List the joints of an arm for a goal of its trajectory controller.

        Parameters
        ----------
        side
            `left` or `right`.

        Returns
        -------
        list of str
            The names, from the shoulder down: four, or six for an arm with a hand.

        """
        wrist = [joint for joint in _WRIST if f'"{side}_{joint}"' in self._model]
        return [f'{side}_{joint}' for joint in (*_ARM, *wrist)]

    @property
    def has_hands(self) -> bool:
        """Whether the robot has hands, according to the description received so far."""
        return any(f'_{joint}"' in self._model for joint in _WRIST)

    def world(self) -> World:
        """Return a snapshot of the world; this queries the ROS graph for each server."""
        lacks = {each.name: self.lack(each) for each in self._skills}
        return World(
            self._surfaces,
            self._rooms,
            self._things,
            {name: reason for name, reason in lacks.items() if reason},
            self.inhibition,
            self.holding,
            self.pose(),
            tuple(base_name(each.name) for each in self.places.surfaces if each.is_container),
        )

    def lack(self, skill: Skill) -> str:
        """
        Explain why a skill is unavailable now.

        Parameters
        ----------
        skill
            The skill. A compound skill lacks nothing itself.

        Returns
        -------
        str
            The reason, as a message; empty if the skill is available.

        """
        if skill.steps:
            return ''
        if skill.name not in self._implemented:
            return f'I cannot {skill.name.replace("_", " ")} yet.'
        name = skill.server
        if skill.server_kind == 'action':
            name = f'{name}/_action/send_goal'
        if not name or self._node.count_services(self._node.resolve_service_name(name)):
            return ''
        return skill.without or f"I cannot do that, as '{skill.server}' is not running."

    def lacks(self, name: str) -> bool:
        """
        Check whether a skill is unavailable now.

        Parameters
        ----------
        name
            The name of the skill.

        """
        return bool(self.lack(self._skills[name]))

    def surface(self, name: str) -> Surface | None:
        """
        Look up the first board of a piece of furniture.

        Parameters
        ----------
        name
            Its base name, such as `shelf`.

        Returns
        -------
        Surface or None
            None if no surface has that name.

        """
        boards = (each for each in self.places.surfaces if base_name(each.name) == name)
        return next(boards, None)

    def room(self, name: str) -> Room | None:
        """
        Look up a room.

        Parameters
        ----------
        name
            Its name.

        Returns
        -------
        Room or None
            None if no room has that name.

        """
        return next((each for each in self.places.rooms if each.name == name), None)

    def pose(self) -> tuple[float, float, float] | None:
        """Return the pose of the robot in the map: x and y in m, yaw in rad; None if unknown."""
        try:
            transform = self._buffer.lookup_transform(_MAP, _BASE, Time()).transform
        except TransformException:
            return None
        return planar_of(transform)

    def point_from_robot(
        self, point_m: tuple[float, float, float]
    ) -> tuple[float, float, float] | None:
        """
        Transform a point from the map frame to the base frame of the robot, on the floor.

        Parameters
        ----------
        point_m
            The point in the map frame.

        Returns
        -------
        tuple or None
            The point in the base frame (m); None if the pose of the robot is unknown.

        """
        try:
            found = self._buffer.lookup_transform(_BASE, _MAP, Time()).transform
        except TransformException:
            return None
        position, rotation = pose_of(found)
        x, y, z = position + rotation @ np.array(point_m)
        return float(x), float(y), float(z)

    def _take_model(self, message: String) -> None:
        self._model = message.data

    def _take_held(self, message: Detection3DArray) -> None:
        self._held = {
            _side_of(each.header.frame_id): KnownObject(each.id, *_class_and_colour(each)).name
            for each in message.detections
            if each.results
        }

    def _take(self, message: Detection3DArray) -> None:
        self._things = tuple(
            _thing(each, self.places) for each in message.detections if each.results
        )


def _side_of(gripper_frame: str) -> str:
    """Return the side of a gripper frame, such as `l_gripper` or `robot2/l_gripper`."""
    return 'left' if gripper_frame.rpartition('/')[2].startswith('l_') else 'right'


def _thing(detection: Any, places: Places) -> KnownObject:
    """Convert a detection to a remembered object."""
    centre, size = detection.bbox.center.position, detection.bbox.size
    covariance_m2 = np.reshape(detection.results[0].pose.covariance, (6, 6))[:3, :3]
    sigma_m = greatest_sigma_m(covariance_m2)
    place = places.surface_at(centre.x, centre.y, centre.z - 0.5 * size.z, sigma_m)
    return KnownObject(
        detection.id,
        *_class_and_colour(detection),
        place,
        places.room_at(centre.x, centre.y),
        (centre.x, centre.y, centre.z),
        (size.x, size.y, size.z),
    )


def _class_and_colour(detection: Any) -> tuple[str, str]:
    """Return the class of a detection, and the colour from a further name such as `red mug`."""
    class_id = detection.results[0].hypothesis.class_id
    names = [each.hypothesis.class_id for each in detection.results[1:]]
    colour = next(
        (name[: -len(class_id) - 1] for name in names if name.endswith(f' {class_id}')), ''
    )
    return class_id, colour
