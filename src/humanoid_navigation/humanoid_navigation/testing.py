# SPDX-License-Identifier: Apache-2.0
"""Navigate a simulated robot to goal poses, and observe it; for tests and experiments."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import math
from pathlib import Path
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from humanoid_common.qos import COMMAND, SENSOR, STATE
from humanoid_common.testing.ros import RosSandbox
from humanoid_interfaces.msg import Contacts
from humanoid_navigation.arrival import Arrival, initial_pose, is_zero, stamped
from humanoid_simulation.testing.simulators import RobotClient
from nav2_msgs.action import NavigateToPose
import numpy as np
import numpy.typing as npt
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.task import Future

PATIENCE_S = 90.0
"""Timeout in real time for responses that should arrive at once."""
GROUND = ('floor', 'world', 'ground', 'rug')
"""Prefixes of the names of bodies that a robot may stand on."""
LIMBS = ('left_', 'right_', 'base_', 'torso', 'head', 'waist', 'pelvis')
"""Prefixes of the names of its own links."""


class NavigatingRobot:
    """
    A robot in a simulator that is navigated by Nav2.

    Parameters
    ----------
    ros
        The nodes of the test.

    """

    def __init__(self, ros: RosSandbox) -> None:
        self._ros = ros
        self.robot = RobotClient(ros)
        self._node = ros.start(lambda **options: Node('traveller', **options))
        self._client = ActionClient(self._node, NavigateToPose, 'navigate_to_pose')
        self._initial_pose = self._node.create_publisher(
            PoseWithCovarianceStamped, 'initialpose', STATE
        )
        self.command: Twist | None = None
        """The newest velocity command of the robot."""
        self._touched: set[str] = set()
        self._recoveries = 0
        self._node.create_subscription(Twist, 'cmd_vel', self._take_command, COMMAND)
        self._node.create_subscription(Contacts, 'contacts', self._take_contacts, SENSOR)
        ros.wait_until(self._client.server_is_ready, PATIENCE_S, 'the action navigate_to_pose')

    def say_where(self, x_m: float, y_m: float, yaw_rad: float) -> None:
        """
        Publish a pose for the localisation on `initialpose`, and wait a second.

        Parameters
        ----------
        x_m, y_m, yaw_rad
            The pose in the map that is published, right or wrong.

        """
        self._initial_pose.publish(initial_pose((x_m, y_m, yaw_rad), 0.25, 0.07))
        self.robot.wait(1.0)

    def start(self, x_m: float, y_m: float, yaw_rad: float) -> Any:
        """
        Send a `NavigateToPose` goal, and retry for 20 s while it is rejected.

        Parameters
        ----------
        x_m, y_m, yaw_rad
            The goal pose in the map.

        Returns
        -------
        Any
            The handle of the accepted goal, for `finish`, `ended` and `cancel`.

        Raises
        ------
        AssertionError
            The goal is still rejected.

        """
        goal = NavigateToPose.Goal(pose=stamped((x_m, y_m, yaw_rad)))
        self._touched.clear()
        self._recoveries = 0
        self.robot.topics.drive(None)  # a reset of the robot leaves a repeated zero command
        for _ in range(20):
            handle = self._answer(
                self._client.send_goal_async(goal, feedback_callback=self._take_feedback)
            )
            if handle.accepted:
                return handle
            self.robot.wait(1.0)  # the nodes are being activated
        raise AssertionError('The goal was rejected for 20 s.')

    def finish(
        self,
        handle: Any,
        x_m: float,
        y_m: float,
        yaw_rad: float,
        at_most_s: float,
        watch: Callable[[], None] = lambda: None,
    ) -> Arrival:
        """
        Wait for the result of a goal, and cancel it after a timeout.

        Parameters
        ----------
        handle
            The handle that `start` returned.
        x_m, y_m, yaw_rad
            The goal pose in the map, which the arrival is compared with.
        at_most_s
            Timeout, in s of simulated time.
        watch
            Called repeatedly until the goal ends.

        Raises
        ------
        FellError
            The robot falls.

        """
        begin_s = self.robot.topics.time_s
        result = handle.get_result_async()

        def ended() -> bool:
            watch()
            return bool(result.done())

        if not self.robot.wait_until(ended, at_most_s):
            self._answer(handle.cancel_goal_async())
            self._ros.wait_until(result.done, PATIENCE_S, 'the end of a canceled goal')
        return self._arrival(result.result(), x_m, y_m, yaw_rad, begin_s)

    def ended(self, handle: Any, x_m: float, y_m: float, yaw_rad: float) -> Arrival:
        """
        Wait for the result of a goal without expecting the robot to stay on its feet.

        Parameters
        ----------
        handle
            The handle that `start` returned.
        x_m, y_m, yaw_rad
            The goal pose in the map, which the arrival is compared with.

        Returns
        -------
        Arrival
            How the goal ended; its `took_s` is 0.

        """
        answer = self._answer(handle.get_result_async())
        return self._arrival(answer, x_m, y_m, yaw_rad, self.robot.topics.time_s)

    def _arrival(
        self, answer: Any, x_m: float, y_m: float, yaw_rad: float, begin_s: float
    ) -> Arrival:
        pose = self.robot.pose
        turn = math.remainder(pose.yaw_rad - yaw_rad, math.tau)
        return Arrival(
            answer.status,
            answer.result.error_code,
            answer.result.error_msg,
            abs(pose.position_m - complex(x_m, y_m)),
            abs(turn),
            self.robot.topics.time_s - begin_s,
            self._recoveries,
            frozenset(self._touched),
        )

    def go(self, x_m: float, y_m: float, yaw_rad: float, at_most_s: float = 120.0) -> Arrival:
        """
        Navigate to a pose, and return the result.

        Parameters
        ----------
        x_m, y_m, yaw_rad
            The goal pose in the map.
        at_most_s
            Timeout, in s of simulated time, after which the goal is canceled.

        Raises
        ------
        AssertionError
            The goal is rejected for 20 s, or the robot falls.

        """
        return self.finish(self.start(x_m, y_m, yaw_rad), x_m, y_m, yaw_rad, at_most_s)

    def cancel(self, handle: Any) -> float:
        """
        Cancel a goal, and measure how long the robot keeps moving.

        Parameters
        ----------
        handle
            The handle that `start` returned.

        Returns
        -------
        float
            The simulated time in s from the answer to the cancel request to zero velocity.

        Raises
        ------
        AssertionError
            The velocity is not zero after 5 s.

        """
        self._answer(handle.cancel_goal_async())
        begin_s = self.robot.topics.time_s
        assert self.robot.wait_until(lambda: not self.is_moved, 5.0), 'The robot is still moving.'
        return self.robot.topics.time_s - begin_s

    @property
    def is_moved(self) -> bool:
        """Whether the newest velocity command is not zero."""
        return self.command is not None and not is_zero(self.command)

    def _answer(self, future: Future) -> Any:
        self._ros.wait_until(future.done, PATIENCE_S, 'an answer of the navigator')
        return future.result()

    def _take_command(self, message: Twist) -> None:
        self.command = message

    def _take_feedback(self, message: Any) -> None:
        self._recoveries = message.feedback.number_of_recoveries

    def _take_contacts(self, message: Contacts) -> None:
        for contact in message.contacts:
            for body in (contact.body1, contact.body2):
                self._touched.add(body)
        self._touched -= {body for body in self._touched if _is_robot_or_ground(body)}


def _is_robot_or_ground(body: str) -> bool:
    return body.startswith((*GROUND, *LIMBS))


def random_goals(
    map_file: Path, clearance_m: float, seed: int
) -> Iterator[tuple[float, float, float]]:
    """
    Yield random poses (m, m, rad) in a map with free space around them, endlessly.

    Parameters
    ----------
    map_file
        The YAML file of a map whose image is a PGM.
    clearance_m
        Minimum distance from all cells that are not free.
    seed
        Seed of the random numbers.

    """
    free, resolution_m, origin_m = _free_cells(map_file)
    reach = math.ceil(clearance_m / resolution_m)
    steps = range(-reach, reach + 1)
    inner = free.copy()
    for rows in steps:
        for columns in steps:
            if rows * rows + columns * columns <= reach * reach:
                inner &= np.roll(free, (rows, columns), axis=(0, 1))
    cells = np.argwhere(inner)
    random = np.random.default_rng(seed)
    while True:
        row, column = cells[random.integers(len(cells))]
        yield (
            float(origin_m[0] + (column + 0.5) * resolution_m),
            float(origin_m[1] + (row + 0.5) * resolution_m),
            float(random.uniform(-math.pi, math.pi)),
        )


def _free_cells(map_file: Path) -> tuple[npt.NDArray[np.bool_], float, tuple[float, float]]:
    """Return the free cells of a map, bottom row first, its resolution and its origin."""
    import yaml

    table = yaml.safe_load(map_file.read_text(encoding='utf-8'))
    data = (map_file.parent / table['image']).read_bytes()
    _, size, _, pixels = data.split(b'\n', 3)
    width, height = map(int, size.split())
    grey = np.frombuffer(pixels, np.uint8, width * height).reshape(height, width)[::-1]
    return grey > 250, float(table['resolution']), tuple(table['origin'][:2])
