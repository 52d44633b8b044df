# SPDX-License-Identifier: Apache-2.0
"""Navigation as a whole, in the loopback simulator: what is reached, and how it ends otherwise."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import sys
from typing import Any

from action_msgs.msg import GoalStatus
import cv2
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from nav2_behaviors.behavior_server import BehaviorServer
from nav2_bt_navigator import BtNavigator
from nav2_controller.controller_server import ControllerServer
from nav2_loopback_sim.loopback_simulator import LoopbackSimulator
from nav2_map_server.map_server import MapServer
from nav2_msgs.action import FollowWaypoints, NavigateThroughPoses, NavigateToPose
from nav2_planner.planner_server import PlannerServer
from nav2_waypoint_follower import WaypointFollower
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))
from navigation_servers import Client, pose  # noqa: E402, I100

PARAMETERS = str(Path(__file__).parents[1] / 'nav2_bringup' / 'params' / 'nav2_params.yaml')
SUCCEEDED = GoalStatus.STATUS_SUCCEEDED
ABORTED = GoalStatus.STATUS_ABORTED
CANCELED = GoalStatus.STATUS_CANCELED
SIMULATOR = (
    'use_sim_time:=true',
    'speed:=4.0',
    'update_duration:=0.05',
    'base_frame_id:=base_link',
    'scan_frame_id:=base_link',
)


def write_map(folder: Path) -> str:
    """Write a map of 8 x 8 m with a wall and a closed room; return its yaml file."""
    cells = np.full((160, 160), 254, np.uint8)
    cells[:3] = cells[-3:] = cells[:, :3] = cells[:, -3:] = 0
    cells[80:83, :100] = 0
    cells[15:18, 120:158] = cells[50:53, 120:158] = cells[15:53, 120:123] = 0
    cv2.imwrite(str(folder / 'map.pgm'), cells)
    text = 'image: map.pgm\nresolution: 0.05\norigin: [-4.0, -4.0, 0.0]\nnegate: 0\n'
    path = folder / 'map.yaml'
    path.write_text(text + 'occupied_thresh: 0.65\nfree_thresh: 0.25\n')
    return str(path)


class Stack:
    """All servers in one process, and a robot at (-2, -2)."""

    def __init__(self, ros: Any, folder: Path) -> None:
        self.ros, self.node = ros, ros.node('tester')
        self._make(LoopbackSimulator, *SIMULATOR)
        self.servers = [self._make(MapServer, f'yaml_filename:={write_map(folder)}')]
        kinds = (PlannerServer, ControllerServer, BehaviorServer, BtNavigator, WaypointFollower)
        self.servers += [self._make(kind) for kind in kinds]
        for server in self.servers:
            assert server.trigger_configure().name == 'SUCCESS'
            for each in server.companions:
                if each.executor is None:
                    ros.executor.add_node(each)
        self.servers[0].trigger_activate()
        self._place(-2.0, -2.0)
        for server in self.servers[1:]:
            assert server.trigger_activate().name == 'SUCCESS'
        self.velocities: list[Twist] = []
        self.node.create_subscription(Twist, 'cmd_vel', self.velocities.append, 10)
        self.client = Client(ros, self.node, NavigateToPose, 'navigate_to_pose')

    def _make(self, kind: Any, *more: str) -> Any:
        arguments = ['--ros-args', '--params-file', PARAMETERS]
        for each in ('use_sim_time:=true', 'enable_stamped_cmd_vel:=false', *more):
            arguments += ['-p', each]
        return self.ros.add(kind(context=self.ros.context, cli_args=arguments))

    def _place(self, x: float, y: float) -> None:
        publisher = self.node.create_publisher(PoseWithCovarianceStamped, 'initialpose', 1)
        self.ros.wait_until(publisher.get_subscription_count)
        told = PoseWithCovarianceStamped()
        told.header.frame_id = 'map'
        told.pose.pose.position.x, told.pose.pose.position.y = x, y
        publisher.publish(told)
        interface = self.servers[4].ros
        self.ros.wait_until(lambda: interface.can_transform('map', 'base_link'), what='tf')
        self.ros.spin(0.5)

    @property
    def robot(self) -> Any:
        """Where the robot is."""
        return self.servers[4].ros.robot_pose()


@pytest.fixture(scope='module')
def stack(tmp_path_factory: pytest.TempPathFactory, ros_class: Any) -> Iterator[Stack]:
    """Return a stack that all tests of this file use, one after another."""
    import rclpy
    from rclpy.context import Context

    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    context = Context()
    rclpy.init(args=[], context=context)
    ros = ros_class(context)
    made = Stack(ros, tmp_path_factory.mktemp('map'))
    yield made
    made.client.close()
    ros.close()
    context.try_shutdown()


def test_a_goal_behind_a_wall_is_reached(stack: Stack) -> None:
    """Within the tolerance of the goal checker."""
    status, result = stack.client.wait(stack.client.send(pose=pose(-2.0, 2.0)), 60.0)
    assert (status, result.error_msg) == (SUCCEEDED, '')
    assert abs(stack.robot.x + 2.0) < 0.3 and abs(stack.robot.y - 2.0) < 0.3


def test_a_closed_room_is_given_up_with_the_reason(stack: Stack) -> None:
    """In less than 20 s of the simulation."""
    start_s = stack.servers[4].ros.now_s()
    status, result = stack.client.wait(stack.client.send(pose=pose(3.0, 2.3)), 60.0)
    assert (status, result.error_code) == (ABORTED, 208)
    assert 'The planner found no way to the goal' in result.error_msg
    assert stack.servers[4].ros.now_s() - start_s < 20.0


def test_canceling_stops_the_robot(stack: Stack) -> None:
    """A velocity of zero comes at once, and is the last one."""
    handle = stack.client.send(pose=pose(-2.0, -2.0))
    moving = lambda: stack.velocities and stack.velocities[-1].linear.x > 0.05  # noqa: E731
    stack.ros.wait_until(moving)
    stack.velocities.clear()
    handle.cancel_goal_async()
    assert stack.client.wait(handle)[0] == CANCELED
    zero = Twist()
    stack.ros.wait_until(lambda: zero in stack.velocities)
    assert stack.velocities.index(zero) <= 10, '20 velocities a second are commanded'
    stack.ros.spin(0.3)
    assert stack.velocities[-1] == zero


def test_waypoints_and_poses_on_the_way(stack: Stack) -> None:
    """Both drive through all."""
    follow = Client(stack.ros, stack.node, FollowWaypoints, 'follow_waypoints')
    status, result = follow.wait(follow.send(poses=[pose(-2.0, 2.0), pose(-1.0, 1.5)]), 60.0)
    assert (status, len(result.missed_waypoints)) == (SUCCEEDED, 0)
    through = Client(stack.ros, stack.node, NavigateThroughPoses, 'navigate_through_poses')
    status, _ = through.wait(through.send(poses=[pose(0.0, 1.5), pose(0.5, 2.5)]), 60.0)
    assert status == SUCCEEDED
    follow.close()
    through.close()
