# SPDX-License-Identifier: Apache-2.0
"""ROS interface of the tree nodes: shared clients, newest messages, the robot's pose and speed."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
import math
import time
from typing import Any

from nav2_util import LifecycleNode, Pose2D
from nav2_util.qos import LATCHED
from nav2_util.timing import now_s
from rclpy.action import ActionClient
from rclpy.qos import qos_profile_system_default, QoSProfile
from rclpy.time import Time

__all__ = ['LATCHED', 'SYSTEM_DEFAULT', 'Latest', 'OdometrySmoother', 'RosInterface']

SYSTEM_DEFAULT = qos_profile_system_default


@dataclass
class Latest:
    """Newest message of a topic, None before the first, and the number of messages received."""

    message: Any = None
    count: int = 0


class RosInterface:
    """
    ROS interface for the nodes of all trees of a navigator.

    Parameters
    ----------
    node
        The node that owns the clients.
    odometry
        The robot's velocity.
    global_frame, robot_base_frame
        The default frames.
    server_timeout_s
        The timeout for a server to accept a goal or to respond.
    wait_for_service_timeout_s
        The timeout for a server to become available.
    transform_tolerance_s
        The maximum age of transforms; not applied to the newest ones.

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
        """Return the time in s of a steady clock, for timeouts of other nodes."""
        return time.monotonic()

    def stamp(self) -> Any:
        """Return the time of the node's clock as a message for a header."""
        return self.node.get_clock().now().to_msg()

    def action_client(self, kind: Any, name: str) -> ActionClient:
        """
        Get the client of an action, created once.

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
        Get the client of a service, created once.

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
        Subscribe to a topic, once per topic.

        Parameters
        ----------
        kind
            The type of the messages.
        topic
            Its name, which the node resolves and remaps.
        qos
            The quality of service of the subscription; that of the first call is used.

        Returns
        -------
        Latest
            Holder of the newest message; the same object for all callers.

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
        Look up the newest pose of the robot.

        Parameters
        ----------
        in_frame
            The frame of the pose; `global_frame` if empty.
        base_frame
            The frame of the robot; `robot_base_frame` if empty.

        Raises
        ------
        TransformError
            The pose is not available.

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
            The target frame; `global_frame` if empty.

        Raises
        ------
        TransformError
            The frame of the pose is empty, or the transform is not available.

        """
        return self.node.transforms.pose_in(pose, in_frame or self.global_frame)

    def can_transform(self, parent: str, child: str) -> bool:
        """
        Whether the newest transform between two frames is available.

        Parameters
        ----------
        parent, child
            The names of the frames.

        """
        return bool(self.node.transforms.buffer.can_transform(child, parent, Time()))

    def speed_m_s(self) -> float:
        """Return the forward velocity of the robot."""
        return self._odometry.velocity[0]

    def motion(self) -> float:
        """Return the speed of the robot in m/s, or its yaw rate in rad/s if that is more."""
        return self._odometry.motion

    def acceleration_m_s2(self) -> float:
        """Return the forward acceleration of the robot."""
        return self._odometry.acceleration_m_s2

    def parameter(self, name: str, default: Any, description: str) -> Any:
        """
        Get a parameter of the navigator, which is only declared if a tree needs it.

        Parameters
        ----------
        name
            Its full name.
        default
            Its value if it is not set, which also gives its type.
        description
            Its purpose, with the unit.

        """
        return self.node.parameters.declare_value(name, default, description)

    def close(self) -> None:
        """Destroy the action clients; the node destroys the others."""
        for client in self._actions.values():
            client.destroy()
        self._actions.clear()
        self._services.clear()
        self._topics.clear()


class OdometrySmoother:
    """
    Moving average of the velocities of the last `duration_s`.

    Parameters
    ----------
    duration_s
        The length of the window in s.

    """

    def __init__(self, duration_s: float) -> None:
        self._duration_s = duration_s
        self._samples: deque[tuple[float, float, float, float]] = deque()

    def add(self, time_s: float, x_m_s: float, yaw_rad_s: float, y_m_s: float = 0.0) -> None:
        """
        Add a sample; drop samples older than the duration, or all if time jumps back.

        Parameters
        ----------
        time_s
            The time of the measurement in s.
        x_m_s
            The forward velocity in m/s.
        yaw_rad_s
            The yaw rate in rad/s.
        y_m_s
            The velocity to the left in m/s.

        """
        if self._samples and time_s < self._samples[-1][0]:
            self._samples.clear()
        self._samples.append((time_s, x_m_s, yaw_rad_s, y_m_s))
        while self._samples[0][0] < time_s - self._duration_s:
            self._samples.popleft()

    @property
    def velocity(self) -> tuple[float, float]:
        """Forward velocity in m/s and yaw rate in rad/s; 0 if no sample is available."""
        return self._mean(1), self._mean(2)

    @property
    def motion(self) -> float:
        """Speed in m/s, or yaw rate in rad/s if that is more; 0 if no sample is available."""
        return max(math.hypot(self._mean(1), self._mean(3)), abs(self._mean(2)))

    def _mean(self, index: int) -> float:
        count = len(self._samples)
        return sum(sample[index] for sample in self._samples) / count if count else 0.0

    @property
    def acceleration_m_s2(self) -> float:
        """Return the mean forward acceleration over the same window."""
        if len(self._samples) < 2 or self._samples[-1][0] <= self._samples[0][0]:
            return 0.0
        first, last = self._samples[0], self._samples[-1]
        return (last[1] - first[1]) / (last[0] - first[0])
