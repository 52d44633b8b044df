# SPDX-License-Identifier: Apache-2.0
"""Check what is asked of a trajectory controller, and how its answers are taken."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from control_msgs.action import FollowJointTrajectory
from humanoid_common.joint_mover import JointMover, trajectory_point
from humanoid_common.single_goal import GoalAborted
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
import pytest
from rclpy.action import ActionServer, CancelResponse, GoalResponse

JOINTS = ('left_elbow', 'left_wrist_yaw')
Result = FollowJointTrajectory.Result


class Controller:
    """A controller that ends each goal as it is told to."""

    def __init__(self, ros: RosSandbox) -> None:
        """Offer the action."""
        self.ros, self.node = ros, ros.observer()
        self.goals: list[Any] = []
        self.canceled = 0
        self.accepts, self.result = True, Result()
        self.waits = False
        self._server = ActionServer(
            self.node,
            FollowJointTrajectory,
            'arm_controller/follow_joint_trajectory',
            self._execute,
            goal_callback=self._check,
            cancel_callback=self._cancel,
        )
        self.mover = JointMover(ros.observer(), JOINTS, 'arm_controller', 'FAILED', 'BLOCKED')
        ros.wait_until(lambda: self.mover.is_ready, 30.0, 'the controller')

    def end(self) -> bool:
        """Let the mover wait for the end of its motion."""
        ended = []

        def is_over() -> bool:
            try:
                ended.append(self.mover.has_arrived())
            except GoalAborted as error:
                ended.append(error)
            return bool(ended[-1])

        self.ros.wait_until(is_over, 30.0, 'the end')
        if isinstance(ended[-1], GoalAborted):
            raise ended[-1]
        return bool(ended[-1])

    def _check(self, goal: Any) -> GoalResponse:
        self.goals.append(goal)
        return GoalResponse.ACCEPT if self.accepts else GoalResponse.REJECT

    def _cancel(self, _: Any) -> CancelResponse:
        self.canceled += 1
        return CancelResponse.ACCEPT

    def _execute(self, handle: Any) -> Any:
        if self.result.error_code:
            handle.abort()
        else:
            handle.succeed()
        return self.result


@pytest.fixture(name='controller')
def _controller() -> Iterator[Controller]:
    """Give a controller."""
    with ros_sandbox() as ros:
        yield Controller(ros)


def test_a_motion_names_all_joints_and_its_tolerances(controller: Controller) -> None:
    """Times since the start, positions and velocities."""
    points = [trajectory_point(0.5, (0.1, 0.2)), trajectory_point(1.25, (0.3, 0.4), (0.0, 0.0))]
    controller.mover.send(points, 0.3, 1.5)
    assert controller.end()
    (goal,) = controller.goals
    assert list(goal.trajectory.joint_names) == list(JOINTS)
    times = [each.time_from_start for each in goal.trajectory.points]
    assert [(each.sec, each.nanosec) for each in times] == [(0, 500_000_000), (1, 250_000_000)]
    assert list(goal.trajectory.points[0].velocities) == []
    assert [(each.name, each.position) for each in goal.path_tolerance] == [
        (joint, 0.3) for joint in JOINTS
    ]
    assert goal.goal_time_tolerance.sec == 1


def test_without_tolerances_any_error_is_fine(controller: Controller) -> None:
    """As the action has it."""
    controller.mover.send([trajectory_point(0.5, (0.1, 0.2))])
    assert controller.end()
    assert list(controller.goals[0].path_tolerance) == []


@pytest.mark.parametrize(
    ('code', 'name'),
    [
        (Result.PATH_TOLERANCE_VIOLATED, 'BLOCKED'),
        (Result.GOAL_TOLERANCE_VIOLATED, 'BLOCKED'),
        (Result.INVALID_GOAL, 'FAILED'),
    ],
)
def test_how_a_motion_fails(controller: Controller, code: int, name: str) -> None:
    """One that met something is told from others, with the controller's reason."""
    controller.result = Result(error_code=code, error_string='No.')
    controller.mover.send([trajectory_point(0.5, (0.1, 0.2))])
    with pytest.raises(GoalAborted, match=r'No\.') as raised:
        controller.end()
    assert raised.value.name == name


def test_a_motion_that_is_rejected(controller: Controller) -> None:
    """The sentence says where the reason is."""
    controller.accepts = False
    controller.mover.send([trajectory_point(0.5, (0.1, 0.2))])
    with pytest.raises(GoalAborted, match='See the log of the robot for the reason') as raised:
        controller.end()
    assert raised.value.name == 'FAILED'
