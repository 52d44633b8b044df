# SPDX-License-Identifier: Apache-2.0
"""Run Nav2 with the loopback simulator, which has no physics; for tests and experiments."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import math
from pathlib import Path
import re
from typing import Any

from ament_index_python.packages import get_package_share_directory
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from humanoid_common.qos import COMMAND, STATE
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.processes import running_program, RunningProgram
from humanoid_common.testing.ros import RosSandbox
from humanoid_navigation.arrival import Arrival, initial_pose, is_zero, Place, stamped
from humanoid_navigation.client_testing import NavigationClient, SETTLE_S
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener

TICK_S = 0.05
"""The time step of simulated time."""
TELLINGS, TELLING_S = 5, 3.0
"""Attempts and timeout: a scan from the old pose can mislead AMCL at first."""
SETTLED_M, SETTLED_RAD = 0.15, 0.15
CONTAINER = re.compile(r'\[(component_container)-\d+\]: process started with pid \[(\d+)\]')


class LoopbackRobot(NavigationClient):
    """
    A robot in the loopback simulator that is navigated by Nav2.

    Parameters
    ----------
    ros
        The nodes of the test.

    """

    def __init__(self, ros: RosSandbox) -> None:
        super().__init__(ros)
        self.commands: list[tuple[float, Twist]] = []
        """The received velocity commands, with their simulated times."""
        self._odometry: complex | None = None
        self._odometry_rad = 0.0
        self._placed: tuple[complex, float, complex, float] = (0j, 0.0, 0j, 0.0)
        self._recoveries = 0
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, self.node)
        self._initial_pose = self.node.create_publisher(
            PoseWithCovarianceStamped, 'initialpose', STATE
        )
        self.node.create_subscription(Odometry, 'odom', self._take_odometry, STATE)
        self.node.create_subscription(Twist, 'cmd_vel', self._take_command, COMMAND)
        self.navigate = ActionClient(self.node, NavigateToPose, 'navigate_to_pose')

    @property
    def place(self) -> Place:
        """Return the true pose of the robot in the map."""
        begin, begin_rad, odometry, odometry_rad = self._placed
        moved = ((self._odometry or 0j) - odometry) * _turned(begin_rad - odometry_rad)
        yaw_rad = begin_rad + self._odometry_rad - odometry_rad
        position = begin + moved
        return position.real, position.imag, math.remainder(yaw_rad, math.tau)

    @property
    def is_driven(self) -> bool:
        """Whether the newest velocity command is not zero."""
        return bool(self.commands) and not is_zero(self.commands[-1][1])

    def put(self, place: Place) -> None:
        """
        Set the pose of the robot by `initialpose`, as RViz does, until AMCL agrees with it.

        Both the simulator and AMCL use it. It is published again while AMCL disagrees.

        Parameters
        ----------
        place
            x (m), y (m) and yaw (rad) in the map.

        Raises
        ------
        AssertionError
            AMCL does not agree after several attempts.

        """
        self.wait_until(lambda: self._initial_pose.get_subscription_count() >= 2)
        self.wait_until(lambda: self._odometry is not None, what='odometry')
        for _ in range(TELLINGS):
            self._tell(place)
            end_s = self.now_s + TELLING_S
            self.wait_until(
                lambda end_s=end_s: self._is_localised or self.now_s > end_s, what='time'
            )
            self.wait(SETTLE_S)
            if self._is_localised:
                return
        raise AssertionError(f'The robot is not localised at {place}.')

    def _tell(self, place: Place) -> None:
        odometry, odometry_rad = self._odometry or 0j, self._odometry_rad
        self._placed = complex(*place[:2]), place[2], odometry, odometry_rad
        self._initial_pose.publish(initial_pose(place, 0.02, 0.01))

    def send(self, goal: Place, client: ActionClient | None = None, **fields: Any) -> Any:
        """
        Send a `NavigateToPose` goal.

        Parameters
        ----------
        goal
            x (m), y (m) and yaw (rad) in the map.
        client
            The action client; that of `navigate_to_pose` if none is given.
        **fields
            Further fields of the goal message.

        Returns
        -------
        Any
            The handle of the accepted goal, for `finish`.

        """
        message = NavigateToPose.Goal(pose=stamped(goal), **fields)
        return self.send_goal(client or self.navigate, message)

    def send_goal(self, client: ActionClient, goal: Any) -> Any:
        """
        Send a goal of any action, and start to count its recoveries.

        Parameters
        ----------
        client
            The client of the action.
        goal
            The goal message.

        Returns
        -------
        Any
            The goal handle, with the future of its result as `end`, and as `begin_s` the simulated
            time at which it was accepted.

        Raises
        ------
        AssertionError
            The server is not available, does not respond, or rejects the goal.

        """
        self.wait_until(client.server_is_ready, what='an action')
        self._recoveries = 0
        handle = self.answer(client.send_goal_async(goal, self._take_feedback))
        assert handle.accepted, 'The goal was rejected.'
        handle.end, handle.begin_s = handle.get_result_async(), self.now_s
        return handle

    def finish(self, handle: Any, goal: Place, timeout_s: float = 300.0) -> Arrival:
        """
        Wait for the result of a goal, and measure the distance of the robot from it.

        Parameters
        ----------
        handle
            The handle that `send` or `send_goal` returned.
        goal
            The pose that the arrival is compared with: x (m), y (m), yaw (rad) in the map.
        timeout_s
            How long to wait (s), on the computer's clock.

        Raises
        ------
        AssertionError
            The goal does not end in time.

        """
        self.wait_until(handle.end.done, timeout_s, 'the end of the goal')
        answer, place = handle.end.result(), self.place
        return Arrival(
            answer.status,
            answer.result.error_code,
            answer.result.error_msg,
            math.dist(place[:2], goal[:2]),
            abs(math.remainder(place[2] - goal[2], math.tau)),
            self.now_s - handle.begin_s,
            self._recoveries,
        )

    def go(self, goal: Place, timeout_s: float = 300.0) -> Arrival:
        """
        Navigate to a pose, and return the result.

        Parameters
        ----------
        goal
            x (m), y (m) and yaw (rad) in the map.
        timeout_s
            How long to wait (s), on the computer's clock.

        Raises
        ------
        AssertionError
            The goal is rejected, or does not end in time.

        """
        return self.finish(self.send(goal), goal, timeout_s)

    @property
    def _is_localised(self) -> bool:
        """Whether the pose of the robot by TF agrees with the true one."""
        try:
            found = self._buffer.lookup_transform('map', 'base_footprint', Time()).transform
        except TransformException:
            return False
        x_m, y_m, yaw_rad = self.place
        turn = 2 * math.atan2(found.rotation.z, found.rotation.w) - yaw_rad
        away_m = math.hypot(found.translation.x - x_m, found.translation.y - y_m)
        return bool(away_m < SETTLED_M and abs(math.remainder(turn, math.tau)) < SETTLED_RAD)

    def _take_odometry(self, message: Odometry) -> None:
        pose = message.pose.pose
        self._odometry = complex(pose.position.x, pose.position.y)
        self._odometry_rad = 2 * math.atan2(pose.orientation.z, pose.orientation.w)

    def _take_command(self, message: Twist) -> None:
        self.commands.append((self.now_s, message))

    def _take_feedback(self, message: Any) -> None:
        self._recoveries = getattr(message.feedback, 'number_of_recoveries', 0)


@contextmanager
def loopback_simulator(speed: float = 1.0) -> Iterator[RunningProgram]:
    """
    Run Nav2's loopback simulator for the duration of a `with` block.

    Parameters
    ----------
    speed
        Real-time factor of simulated time.

    Yields
    ------
    RunningProgram
        The simulator.

    """
    settings = {
        'speed': speed,
        'update_duration': TICK_S,
        'base_frame_id': 'base_footprint',
        'scan_frame_id': 'laser',
        'publish_map_odom_tf': False,  # amcl does
    }
    command = ['ros2', 'run', 'nav2_loopback_sim', 'loopback_simulator', '--ros-args']
    for name, value in settings.items():
        command += ['-p', f'{name}:={value}']
    with running_program(command) as program:
        yield program


@contextmanager
def running_navigation(*arguments: str) -> Iterator[RunningProgram]:
    """
    Launch Nav2 in the apartment for the duration of a `with` block, on simulated time.

    Parameters
    ----------
    *arguments
        Further launch arguments in the form `name:=value`.

    Yields
    ------
    RunningProgram
        The launch, whose output `container_pid` reads.

    """
    with running_launch_file(
        Path(get_package_share_directory('humanoid_navigation')) / 'launch/navigation.launch.py',
        'map:=apartment',
        'use_sim_time:=True',
        *arguments,
    ) as program:
        yield program


def container_pid(program: RunningProgram) -> int:
    """
    Find the process id of the component container that has all nodes of Nav2.

    Parameters
    ----------
    program
        The launch of Nav2, which has started the container.

    Returns
    -------
    int
        The process id; that of the newest container, if it was respawned.

    """
    return int(CONTAINER.findall(program.output)[-1][1])


def _turned(angle_rad: float) -> complex:
    return complex(math.cos(angle_rad), math.sin(angle_rad))
