# SPDX-License-Identifier: Apache-2.0
"""The true motion of a robot and its scene, as messages for a viewer."""

from __future__ import annotations

import math
from typing import Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, TransformStamped
from humanoid_control.hosting.topics.filling import fill_quaternion, fill_vector
from humanoid_simulation.backend.mujoco_backend import MujocoBackend
from humanoid_simulation.model import in_world
from humanoid_simulation.scene.scene import WORLD
from humanoid_simulation.topics.scene import layer_markers, layers_of, place, thing_markers
from sensor_msgs.msg import JointState
from std_msgs.msg import ColorRGBA
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

BASE = 'base_link'
_WALLS_UP_TO_M = 0.4
_ARROW_S = 1.0
"""How long the arrow of a push is shown, in simulated time."""
_ARROW_M_NS = 0.04
"""Length of an arrow for 1 N s."""
_TEXT_ABOVE_M = 0.9
_ORANGE, _WHITE = ColorRGBA(r=1.0, g=0.5, b=0.1, a=1.0), ColorRGBA(r=1.0, g=1.0, b=1.0, a=1.0)


class Motion:
    """
    Messages about the current state of a simulated world with one robot.

    Parameters
    ----------
    backend
        The world, in which the robot has no name.

    """

    def __init__(self, backend: MujocoBackend) -> None:
        self._backend = backend
        self._joints = backend.joints
        self._places = [int(self._joint(name).qposadr[0]) for name in self._joints]
        self._things = [(thing, thing_markers(thing)) for thing in backend.scene.objects]

    def _joint(self, name: str) -> Any:
        """Return a joint of the MuJoCo model."""
        return self._backend.model.joint(in_world('', name))

    def joint_states(self, stamp: Time) -> JointState:
        """
        Return the true joint positions.

        Parameters
        ----------
        stamp
            The stamp of the message.

        """
        message = JointState(name=[*self._joints])
        message.header.stamp = stamp
        message.position = self._backend.snapshot().qpos[self._places].tolist()
        return message

    def transform(self, stamp: Time) -> TFMessage:
        """
        Return the true pose of the base in the world.

        Parameters
        ----------
        stamp
            The stamp of the message.

        """
        truth = self._backend.ground_truth()
        transform = TransformStamped(child_frame_id=BASE)
        transform.header.frame_id, transform.header.stamp = WORLD, stamp
        fill_vector(transform.transform.translation, truth.position_m)
        fill_quaternion(transform.transform.rotation, truth.orientation)
        return TFMessage(transforms=[transform])

    def scene_markers(self) -> MarkerArray:
        """Return the fixed objects of the scene, which replace all markers before."""
        markers = [Marker(action=Marker.DELETEALL)]
        for name, things in layers_of(self._backend.scene).items():
            markers += layer_markers(name, things, _WALLS_UP_TO_M)
        return MarkerArray(markers=markers)

    def markers(self, title: str, push_ns: complex, push_s: float) -> MarkerArray:
        """
        Return the movable objects, a text above the robot, and an arrow for a recent push.

        Parameters
        ----------
        title
            The text.
        push_ns, push_s
            The last push, in the world frame, and when it began; 0 without.

        """
        markers = [self._text(title), self._arrow(push_ns, self._backend.time_s - push_s)]
        for thing, parts in self._things:
            state = self._backend.entity_state(thing.name)
            for part, marker in parts:
                place(marker, part, state.position_m, state.orientation)
                markers.append(marker)
        return MarkerArray(markers=markers)

    def _text(self, title: str) -> Marker:
        """Return the text above the robot."""
        marker = self._marker('text', Marker.TEXT_VIEW_FACING, _WHITE)
        fill_vector(marker.pose.position, self._backend.ground_truth().position_m)
        marker.pose.position.z += _TEXT_ABOVE_M
        marker.scale.z, marker.text = 0.08, title
        return marker

    def _arrow(self, push_ns: complex, since_s: float) -> Marker:
        """Return the arrow of the last push, which points at the base, or its removal."""
        marker = self._marker('push', Marker.ARROW, _ORANGE)
        if not push_ns or since_s > _ARROW_S:
            marker.action = Marker.DELETE
            return marker
        x, y, z = self._backend.ground_truth().position_m.tolist()
        back = -push_ns * _ARROW_M_NS
        marker.points = [Point(x=x + back.real, y=y + back.imag, z=z), Point(x=x, y=y, z=z)]
        marker.scale.x, marker.scale.y = 0.03, 0.07
        marker.scale.z = min(0.1, math.hypot(back.real, back.imag) / 2)
        return marker

    def _marker(self, namespace: str, kind: int, colour: ColorRGBA) -> Marker:
        """Create a marker in the world frame."""
        marker = Marker(ns=namespace, type=kind, action=Marker.ADD, color=colour)
        marker.header.frame_id = WORLD
        marker.pose.orientation.w = 1.0
        return marker
