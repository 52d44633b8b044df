# SPDX-License-Identifier: Apache-2.0
"""What nodes of a tree have of ROS: clients, newest messages, the robot's pose; made once each."""

from __future__ import annotations

from dataclasses import dataclass
import time
from typing import Any

from nav2_behavior_tree.odometry import OdometrySmoother
from nav2_util import LifecycleNode, Pose2D
from nav2_util.qos import LATCHED
from nav2_util.timing import now_s
from rclpy.action import ActionClient
from rclpy.qos import qos_profile_system_default, QoSProfile
from rclpy.time import Time

__all__ = ['LATCHED', 'SYSTEM_DEFAULT', 'Latest', 'RosInterface']

SYSTEM_DEFAULT = qos_profile_system_default


@dataclass
class Latest:
    """The newest message of a topic, None before the first, and how many have come."""

    message: Any = None
    count: int = 0


class RosInterface:
    """
    Gives the nodes of all trees of a navigator what they need of its node.

    Parameters
    ----------
    node
        The node whose clients they use.
    odometry
        The robot's velocity.
    global_frame, robot_base_frame
        The frames of nodes that are not told others.
    server_timeout_s
        How long a server may take to accept a goal or to answer.
    wait_for_service_timeout_s
        How long a server may be missing.
    transform_tolerance_s
        How far transforms may lie back; not used for the newest ones.

    """

    def __init__(
        self,
        node: LifecycleNode,
        odometry: OdometrySmoother,
        *,
        global_frame: str = 'map',
        robot_base_frame: str = 'base_link',
        server_timeout_s: float = 0.02,
        wait_for_service_timeout_s: float = 1.0,
        transform_tolerance_s: float = 0.1,
    ) -> None:
        self.node, self._odometry = node, odometry
        self.global_frame, self.robot_base_frame = global_frame, robot_base_frame
        self.server_timeout_s = server_timeout_s
        self.wait_for_service_timeout_s = wait_for_service_timeout_s
        self.transform_tolerance_s = transform_tolerance_s
        self._actions: dict[tuple[Any, str], ActionClient] = {}
        self._services: dict[tuple[Any, str], Any] = {}
        self._topics: dict[tuple[Any, str], tuple[Latest, Any]] = {}

    def now_s(self) -> float:
        """Return the time of the node's clock in s."""
        return now_s(self.node)

    @staticmethod
    def watchdog_s() -> float:
        """Return the time in s of a clock that always runs, for what waits for other nodes."""
        return time.monotonic()

    def stamp(self) -> Any:
        """Return the time of the node's clock as the message of a header."""
        return self.node.get_clock().now().to_msg()

    def action_client(self, kind: Any, name: str) -> ActionClient:
        """
        Return the client of an action, made once for each.

        Parameters
        ----------
        kind
            The type of the action.
        name
            Its name, which the node resolves and remaps.

        """
        key = kind, self.node.resolve_service_name(name)
        if key not in self._actions:
            self._actions[key] = ActionClient(self.node, kind, name)
        return self._actions[key]

    def service_client(self, kind: Any, name: str) -> Any:
        """
        Return the client of a service, made once for each.

        Parameters
        ----------
        kind
            The type of the service.
        name
            Its name, which the node resolves and remaps.

        """
        key = kind, self.node.resolve_service_name(name)
        if key not in self._services:
            self._services[key] = self.node.create_client(kind, name)
        return self._services[key]

    def latest(self, kind: Any, topic: str, qos: QoSProfile = SYSTEM_DEFAULT) -> Latest:
        """
        Subscribe to a topic, once for each.

        Parameters
        ----------
        kind
            The type of the messages.
        topic
            Its name, which the node resolves and remaps.
        qos
            The quality of service of the subscription; if there is one already, that of the first
            call.

        Returns
        -------
        Latest
            Where the newest message is kept; the same object for all who ask for the topic.

        """
        key = kind, self.node.resolve_topic_name(topic)
        if key not in self._topics:
            latest = Latest()

            def keep(message: Any) -> None:
                latest.message = message
                latest.count += 1

            subscription = self.node.create_subscription(kind, topic, keep, qos)
            self._topics[key] = latest, subscription
        return self._topics[key][0]

    def robot_pose(self, in_frame: str = '', base_frame: str = '') -> Pose2D:
        """
        Return the newest pose of the robot.

        Parameters
        ----------
        in_frame
            The frame of the pose; `global_frame` if empty.
        base_frame
            The frame of the robot; `robot_base_frame` if empty.

        Raises
        ------
        TransformError
            It is not known.

        """
        return self.node.transforms.pose_of(
            base_frame or self.robot_base_frame, in_frame or self.global_frame
        )

    def pose_in(self, pose: Any, in_frame: str = '') -> Pose2D:
        """
        Transform a pose to another frame.

        Parameters
        ----------
        pose
            A `PoseStamped`.
        in_frame
            The other frame; `global_frame` if empty.

        Raises
        ------
        TransformError
            The frame of the pose is empty, or the transform is not known.

        """
        return self.node.transforms.pose_in(pose, in_frame or self.global_frame)

    def can_transform(self, parent: str, child: str) -> bool:
        """
        Whether the newest transform between two frames is known.

        Parameters
        ----------
        parent, child
            The names of the frames.

        """
        return bool(self.node.transforms.buffer.can_transform(child, parent, Time()))

    def speed_m_s(self) -> float:
        """Return the forward velocity of the robot."""
        return self._odometry.velocity[0]

    def acceleration_m_s2(self) -> float:
        """Return the forward acceleration of the robot."""
        return self._odometry.acceleration_m_s2

    def parameter(self, name: str, default: Any, description: str) -> Any:
        """
        Return a parameter of the navigator that is only declared if a tree needs it.

        Parameters
        ----------
        name
            Its full name.
        default
            Its value if nobody sets it, which is also its type.
        description
            What it does, with the unit.

        """
        return self.node.parameters.declare_value(name, default, description)

    def close(self) -> None:
        """Destroy the clients of actions; the node destroys the others."""
        for client in self._actions.values():
            client.destroy()
        self._actions.clear()
        self._services.clear()
        self._topics.clear()
