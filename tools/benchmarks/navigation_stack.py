# SPDX-License-Identifier: Apache-2.0
"""Start navigation as users do, with the loopback simulator, and measure its cost."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import os
import time
from typing import Any

from domain_coordinator import domain_id
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from measuring import child_of, cpu_s, running
from nav2_msgs.action import NavigateToPose
from nav2_util.geometry import make_pose, make_pose_stamped, Pose2D
import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node

__all__ = ['stack_shares']

SIMULATOR = (
    'ros2 run nav2_loopback_sim loopback_simulator --ros-args '
    '-p base_frame_id:=base_footprint -p scan_frame_id:=laser'
)
NAVIGATION = (
    'ros2 launch humanoid_navigation navigation.launch.py map:=apartment use_sim_time:=True'
)
GOALS = (Pose2D(5.5, 0.5, 0.0), Pose2D(0.5, 0.5, 0.0))
TIMEOUT_S = 90.0
SETTLE_S = 4.0


def stack_shares(seconds: float) -> Iterator[tuple[str, float]]:
    """
    Start the whole stack, and measure the process of all servers.

    Parameters
    ----------
    seconds
        The measurement time of each row.

    Yields
    ------
    The activity of the robot, and the share of a core.

    """
    with domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        with running(SIMULATOR.split()), running(NAVIGATION.split()) as launch:
            rclpy.init()
            driver = _Driver()
            try:
                driver.wait(lambda: driver.is_ready, 'navigation')
                driver.place()
                container = child_of(launch.pid, 'component_container')
                driver.spin(SETTLE_S)
                yield 'standing', driver.share(container, seconds)
                driver.walk()
                driver.spin(SETTLE_S)
                yield 'walking', driver.share(container, seconds)
            finally:
                driver.node.destroy_node()
                rclpy.shutdown()


class _Driver:
    """Client that sends the robot to and fro."""

    def __init__(self) -> None:
        self.node = Node('driver')
        self._client = ActionClient(self.node, NavigateToPose, 'navigate_to_pose')
        self._publisher = self.node.create_publisher(PoseWithCovarianceStamped, 'initialpose', 1)
        self._next = 0
        self._pending: Any = None

    @property
    def is_ready(self) -> bool:
        """Whether the action server is ready, and initial poses have subscribers."""
        return bool(
            self._client.server_is_ready() and self._publisher.get_subscription_count() > 1
        )

    def place(self) -> None:
        """Publish the initial pose of the robot."""
        message = PoseWithCovarianceStamped()
        message.header.frame_id = 'map'
        message.pose.pose = make_pose(Pose2D(0.0, 0.0, 0.0))
        message.pose.covariance[0] = message.pose.covariance[7] = 0.05
        message.pose.covariance[35] = 0.02
        self._publisher.publish(message)

    def walk(self) -> None:
        """Start sending goals, one after the other; a rejected one is sent again."""
        pose = make_pose_stamped(GOALS[self._next % 2], 'map', PoseStamped().header.stamp)
        self._pending = self._client.send_goal_async(NavigateToPose.Goal(pose=pose))
        self._pending.add_done_callback(self._answered)

    def spin(self, seconds: float) -> None:
        """Spin for some time."""
        end_s = time.monotonic() + seconds
        while time.monotonic() < end_s:
            rclpy.spin_once(self.node, timeout_sec=0.1)

    def wait(self, is_enough: Callable[[], bool], what: str) -> None:
        """Spin until a condition holds."""
        end_s = time.monotonic() + TIMEOUT_S
        while not is_enough():
            if time.monotonic() > end_s:
                raise SystemExit(f'Waited {TIMEOUT_S:g} s for {what}.')
            self.spin(0.2)

    def share(self, process: int, seconds: float) -> float:
        """Measure the share of a core that a process uses."""
        begin_s, begin_cpu_s = time.monotonic(), cpu_s(process)
        self.spin(seconds)
        return (cpu_s(process) - begin_cpu_s) / (time.monotonic() - begin_s)

    def _answered(self, answer: Any) -> None:
        handle = answer.result()
        if not handle.accepted:
            self.spin(0.5)
            self.walk()
            return
        self._next += 1
        handle.get_result_async().add_done_callback(lambda _: self.walk())
