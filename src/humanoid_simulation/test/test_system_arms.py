# SPDX-License-Identifier: Apache-2.0
"""Move both arms by actions, as a motion planner does, while the robot walks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTolerance
from humanoid_common.testing.actions import ActionCaller
from humanoid_common.testing.ros import RosSandbox
from humanoid_control.testing import trajectory_goal
from humanoid_simulation.testing.simulators import RobotClient, simulation
import numpy as np
import pytest
from sensor_msgs.msg import JointState

PARTS = ('shoulder', 'shoulder_roll', 'shoulder_yaw', 'elbow')
SIDES = ('left', 'right')
FASTEST_RAD_S = 4.0
"""No goal asks for more, and where one follows another, nothing jumps either."""
Result = FollowJointTrajectory.Result


class Arms:
    """A robot that walks, and clients of both arms."""

    def __init__(self, ros: RosSandbox) -> None:
        """Find the robot and the actions."""
        self.robot = RobotClient(ros)
        self.states: list[JointState] = []
        ros.observer().create_subscription(JointState, 'joint_states', self.states.append, 100)
        self.clients = {
            side: ActionCaller(
                ros, FollowJointTrajectory, f'{side}_arm_controller/follow_joint_trajectory'
            )
            for side in SIDES
        }
        ros.wait_until(lambda: bool(self.states), 60.0, 'joint states')

    def close(self) -> None:
        """End the clients."""
        for client in self.clients.values():
            client.close()

    def here_rad(self, side: str) -> list[float]:
        """Return where the joints of an arm are."""
        state = self.states[-1]
        at = dict(zip(state.name, state.position))
        return [at[f'{side}_{part}'] for part in PARTS]

    def send(self, side: str, *points: tuple[float, list[float]], **fields: Any) -> Any:
        """Send a way that begins with the present state, as planners do; return its handle."""
        joints = [f'{side}_{part}' for part in PARTS]
        goal = trajectory_goal(joints, (0.0, self.here_rad(side)), *points, **fields)
        return self.clients[side].send(goal)

    def end_of(self, side: str, handle: Any, at_most_s: float = 60.0) -> tuple[int, Result]:
        """Let the robot walk until a goal ends."""
        future = handle.get_result_async()
        assert self.robot.wait_until(future.done, at_most_s), 'the goal has not ended'
        return future.result().status, future.result().result


@pytest.fixture(name='arms')
def _arms() -> Iterator[Arms]:
    """Run a simulator for the length of a test."""
    with simulation(scene='apartment', real_time_factor='2.0') as ros:
        arms = Arms(ros)
        yield arms
        arms.close()


def test_both_arms_move_while_the_robot_walks(arms: Arms) -> None:
    """Goals are reached, cancelled, preempted and aborted; the robot walks all the while."""
    robot = arms.robot
    begin = robot.pose
    robot.drive(forward=0.15)
    tolerances = {
        'path_tolerance': [JointTolerance(name='left_elbow', position=0.3)],
        'goal_time_tolerance': Duration(sec=2),
    }
    left = arms.send(
        'left', (1.5, [-0.8, 0.4, 0.0, -1.2]), (3.0, [-0.2, 0.2, 0.2, -0.6]), **tolerances
    )
    right = arms.send('right', (2.0, [-1.0, -0.3, 0.0, -0.9]))
    for side, handle in (('left', left), ('right', right)):
        status, result = arms.end_of(side, handle)
        assert (status, result.error_code) == (GoalStatus.STATUS_SUCCEEDED, Result.SUCCESSFUL)
    assert arms.here_rad('left') == pytest.approx([-0.2, 0.2, 0.2, -0.6], abs=0.15)
    assert len(arms.clients['left'].feedback) > 20

    tight = [JointTolerance(name='right_shoulder', position=0.001)]
    aborted = arms.send('right', (1.0, [-0.2, -0.3, 0.0, -0.4]), path_tolerance=tight)
    status, result = arms.end_of('right', aborted)
    assert (status, result.error_code) == (
        GoalStatus.STATUS_ABORTED,
        Result.PATH_TOLERANCE_VIOLATED,
    )
    assert "'right_shoulder' is off by" in result.error_string

    first = arms.send('left', (20.0, [-1.0, 0.4, 0.0, -1.2]))
    robot.wait(0.5)
    second = arms.send('left', (20.0, [0.4, 0.3, 0.0, -0.3]))
    status, result = arms.end_of('left', first)
    assert status == GoalStatus.STATUS_ABORTED and 'newer goal' in result.error_string
    robot.wait(0.5)
    second.cancel_goal_async()
    assert arms.end_of('left', second)[0] == GoalStatus.STATUS_CANCELED
    robot.wait(0.5)
    held_rad = arms.here_rad('left')
    robot.wait(1.0)
    assert arms.here_rad('left') == pytest.approx(held_rad, abs=0.1)

    assert abs(robot.pose.position_m - begin.position_m) > 0.5
    speeds = np.array([list(state.velocity) for state in arms.states])
    moving = [arms.states[0].name.index(f'{side}_{part}') for side in SIDES for part in PARTS]
    assert np.abs(speeds[:, moving]).max() < FASTEST_RAD_S
    robot.drive()
    robot.wait(2.0)
