# SPDX-License-Identifier: Apache-2.0
"""Move the arms of a robot by actions, as a motion planner does."""

from __future__ import annotations

from collections.abc import Iterator
import random
import time
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointComponentTolerance, JointTolerance
from controller_manager_msgs.srv import ListControllers
from humanoid_common.testing.actions import ActionCaller
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.hosting.conversions import seconds
from humanoid_control.hosting.goal_server import FEEDBACK_RATE_HZ
from humanoid_control.mock_robot import MockRobot
from humanoid_control.testing import trajectory_goal
from humanoid_description.drives import load_drives
import pytest
from rcl_interfaces.msg import Log
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool
from trajectory_msgs.msg import MultiDOFJointTrajectory

ARM = ['left_shoulder', 'left_shoulder_roll', 'left_shoulder_yaw', 'left_elbow']
HEAD = ['head_yaw', 'head_pitch']
Result = FollowJointTrajectory.Result


class World:
    """A mock robot, and what it says."""

    def __init__(self, ros: RosSandbox) -> None:
        """Start the robot."""
        self.ros, self.node = ros, ros.observer()
        self.logs: list[str] = []
        self.joints: dict[str, float] = {}
        self._clients: list[ActionCaller] = []
        self.node.create_subscription(Log, '/rosout', lambda log: self.logs.append(log.msg), 100)
        self.node.create_subscription(JointState, 'joint_states', self._hear, 10)
        self.robot = ros.start(MockRobot, {})
        ros.wait_until(lambda: bool(self.joints), 60.0, 'joints')

    def client(self, name: str = 'left_arm_controller/follow_joint_trajectory') -> ActionCaller:
        """Return a client of an action."""
        self._clients.append(ActionCaller(self.ros, FollowJointTrajectory, name))
        return self._clients[-1]

    def close(self) -> None:
        """End the clients."""
        for client in self._clients:
            client.close()

    def wait(self, what: str, condition: Any) -> None:
        """Wait for something."""
        self.ros.wait_until(condition, 60.0, what)

    def _hear(self, message: JointState) -> None:
        self.joints = dict(zip(message.name, message.position))


@pytest.fixture(name='world')
def _world() -> Iterator[World]:
    """Give a robot in a domain of its own."""
    with ros_sandbox() as sandbox:
        world = World(sandbox)
        yield world
        world.close()


def test_goal_feedback_and_result(world: World) -> None:
    """A goal is followed, told of on the way, reached, and what was reached stays."""
    client = world.client()
    end_rad = [0.3, 0.4, 0.1, -0.9]
    handle = client.send(trajectory_goal(ARM, (0.5, [0.1, 0.2, 0.0, -0.6]), (1.0, end_rad)))
    status, result = client.end_of(handle)
    assert (status, result.error_code) == (GoalStatus.STATUS_SUCCEEDED, Result.SUCCESSFUL)
    assert result.error_string == 'Goal reached.'
    first, last = client.feedback[0], client.feedback[-1]
    took_s = seconds(last.header.stamp) - seconds(first.header.stamp)
    assert 5 <= len(client.feedback) <= FEEDBACK_RATE_HZ * took_s + 2
    assert list(last.joint_names) == ARM and last.header.stamp.sec > 0
    assert last.desired.positions == pytest.approx(end_rad, abs=0.1)
    errors = [a - b for a, b in zip(last.desired.positions, last.actual.positions)]
    assert last.error.positions == pytest.approx(errors)
    assert (
        0.8 < last.desired.time_from_start.sec + last.desired.time_from_start.nanosec / 1e9 <= 1.1
    )

    def is_there() -> bool:
        return [world.joints[joint] for joint in ARM] == pytest.approx(end_rad, abs=0.02)

    world.wait('the arm', is_there)
    other = world.client('head_controller/follow_joint_trajectory')
    other.end_of(other.send(trajectory_goal(HEAD, (1.0, [0.2, 0.1]))))
    assert is_there()


def test_cancel(world: World) -> None:
    """A goal that is cancelled says so, and the arm stays where it was."""
    client = world.client()
    handle = client.send(trajectory_goal(ARM, (20.0, [0.9, 0.4, 0.0, -0.5])))
    world.wait('some way', lambda: world.joints['left_shoulder'] > 0.05)
    answer = client.cancel(handle)
    assert len(answer.goals_canceling) == 1
    status, result = client.end_of(handle)
    assert status == GoalStatus.STATUS_CANCELED
    assert 'held' in result.error_string
    at_rad = world.joints['left_shoulder']
    assert at_rad < 0.8
    other = world.client('head_controller/follow_joint_trajectory')
    other.end_of(other.send(trajectory_goal(HEAD, (1.0, [0.2, 0.1]))))
    assert world.joints['left_shoulder'] == pytest.approx(at_rad, abs=0.05)


def test_preemption(world: World) -> None:
    """A new goal ends the one that runs, also that of another client."""
    one, two = world.client(), world.client()
    first = one.send(trajectory_goal(ARM, (30.0, [0.9, 0.4, 0.0, -0.5])))
    second = two.send(trajectory_goal(ARM, (0.5, [0.1, 0.2, 0.0, -0.5])))
    status, result = one.end_of(first)
    assert status == GoalStatus.STATUS_ABORTED
    assert (result.error_code, result.error_string) == (
        Result.INVALID_GOAL,
        'A newer goal took its place.',
    )
    assert two.end_of(second)[0] == GoalStatus.STATUS_SUCCEEDED


def test_path_tolerance(world: World) -> None:
    """An arm that cannot keep to its path says which joint, and by how much."""
    client = world.client()
    tolerance = [JointTolerance(name='left_elbow', position=0.001)]
    handle = client.send(
        trajectory_goal(ARM, (0.4, [0.2, 0.2, 0.0, -1.5]), path_tolerance=tolerance)
    )
    status, result = client.end_of(handle)
    assert status == GoalStatus.STATUS_ABORTED
    assert result.error_code == Result.PATH_TOLERANCE_VIOLATED
    assert "'left_elbow' is off by" in result.error_string
    assert '0.001 rad are tolerated' in result.error_string


def test_goal_tolerance(world: World) -> None:
    """A goal that is not reached in its time says so."""
    client = world.client()
    given = trajectory_goal(
        ARM,
        (0.1, [0.0, 0.2, 0.0, -2.0]),
        goal_tolerance=[JointTolerance(name='left_elbow', position=0.001)],
        goal_time_tolerance=Duration(nanosec=20_000_000),
    )
    status, result = client.end_of(client.send(given))
    assert status == GoalStatus.STATUS_ABORTED
    assert result.error_code == Result.GOAL_TOLERANCE_VIOLATED
    assert "'left_elbow' is off by" in result.error_string


def test_emergency_stop(world: World) -> None:
    """An emergency stop aborts the goal, and no other is accepted until the release."""
    client = world.client()
    stop = world.node.create_publisher(Bool, 'emergency_stop', 1)
    world.wait('the robot', lambda: stop.get_subscription_count() > 0)
    handle = client.send(trajectory_goal(ARM, (30.0, [0.9, 0.4, 0.0, -0.5])))
    stop.publish(Bool(data=True))
    status, result = client.end_of(handle)
    assert status == GoalStatus.STATUS_ABORTED and 'hold still' in result.error_string
    assert not client.send(trajectory_goal(ARM, (1.0, [0.0, 0.2, 0.0, -0.5]))).accepted
    stop.publish(Bool(data=False))
    end = client.end_of

    def is_accepted() -> bool:
        handle = client.send(trajectory_goal(ARM, (0.2, [0.0, 0.2, 0.0, -0.5])))
        return bool(handle.accepted and end(handle)[0] == GoalStatus.STATUS_SUCCEEDED)

    world.wait('a goal after the release', is_accepted)


@pytest.mark.parametrize(
    ('given', 'sentence'),
    [
        (trajectory_goal(ARM), 'It has no points'),
        (
            trajectory_goal(HEAD, (1.0, [0.0, 0.0])),
            "'head_yaw' is not a joint of 'left_arm_controller'",
        ),
        (trajectory_goal(ARM[:3], (1.0, [0.0] * 3)), "It leaves out 'left_elbow'"),
        (trajectory_goal(ARM, (1.0, [0.0] * 4), (1.0, [0.1] * 4)), 'Times must increase'),
        (
            trajectory_goal(ARM, (1.0, [float('nan'), 0.0, 0.0, 0.0])),
            "position of 'left_shoulder' is nan",
        ),
        (trajectory_goal(ARM, (1.0, [99.0, 0.0, 0.0, 0.0])), 'out of its range'),
        (
            trajectory_goal(
                ARM,
                (1.0, [0.0] * 4),
                multi_dof_trajectory=MultiDOFJointTrajectory(joint_names=['base']),
            ),
            'multi_dof_trajectory',
        ),
        (
            trajectory_goal(
                ARM, (1.0, [0.0] * 4), component_path_tolerance=[JointComponentTolerance()]
            ),
            'component tolerances',
        ),
    ],
)
def test_rejected(world: World, given: FollowJointTrajectory.Goal, sentence: str) -> None:
    """A goal that cannot be done is rejected with a sentence in the log; nothing moves."""
    client = world.client()
    world.wait('the log', lambda: bool(world.logs))
    before = dict(world.joints)
    assert not client.send(given).accepted
    world.wait('a sentence', lambda: any(sentence in line for line in world.logs))
    (line,) = (line for line in world.logs if sentence in line)
    assert line.startswith("Rejected a goal of 'left_arm_controller/follow_joint_trajectory'.")
    assert world.joints == pytest.approx(before, abs=1e-3)


def test_old_stamp(world: World) -> None:
    """A trajectory that is over by its stamp is rejected."""
    client = world.client()
    given = trajectory_goal(ARM, (1.0, [0.0, 0.2, 0.0, -0.5]))
    given.trajectory.header.stamp.sec = 1000
    assert not client.send(given).accepted
    world.wait('a sentence', lambda: any('By its header stamp' in x for x in world.logs))


def test_mode_ends_the_goal(world: World) -> None:
    """When the robot changes to a mode that keeps all joints, the goal ends."""
    client = world.client()
    handle = client.send(trajectory_goal(ARM, (30.0, [0.9, 0.4, 0.0, -0.5])))
    world.robot.set_parameters([Parameter('mode', value='hold')])
    status, result = client.end_of(handle)
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, Result.INVALID_GOAL)
    assert not client.send(trajectory_goal(ARM, (1.0, [0.0, 0.2, 0.0, -0.5]))).accepted


def test_a_hundred_goals_at_random(world: World) -> None:
    """Sent, cancelled and preempted: each ends, no joint jumps, and none is left without owner."""
    chance, drives = random.Random(7), load_drives()
    fastest: dict[str, float] = {}

    def hear(message: JointState) -> None:
        for joint, rate in zip(message.name, message.velocity):
            fastest[joint] = max(fastest.get(joint, 0.0), abs(rate))

    world.node.create_subscription(JointState, 'joint_states', hear, 10)
    joints = {'left_arm': ARM, 'right_arm': [name.replace('left', 'right') for name in ARM]}
    joints['head'] = HEAD
    clients = {name: world.client(f'{name}_controller/follow_joint_trajectory') for name in joints}
    ends = []
    for _ in range(100):
        name = chance.choice(list(joints))
        centre_rad = [-0.6 if 'elbow' in joint else 0.0 for joint in joints[name]]
        way = [
            (0.2 * (1 + k), [at + chance.uniform(-0.3, 0.3) for at in centre_rad])
            for k in range(2)
        ]
        handle = clients[name].send(trajectory_goal(joints[name], *way))
        assert handle.accepted
        ends.append(handle.get_result_async())
        end_s = time.monotonic() + chance.choice([0.0, 0.02, 0.1, 0.5])
        world.wait('some time', lambda: time.monotonic() >= end_s)  # noqa: B023
        if chance.random() < 0.4:
            clients[name].cancel(handle)
    world.wait('the ends', lambda: all(end.done() for end in ends))
    statuses = {end.result().status for end in ends}
    assert statuses == {
        GoalStatus.STATUS_SUCCEEDED,
        GoalStatus.STATUS_CANCELED,
        GoalStatus.STATUS_ABORTED,
    }
    for joint, rate in fastest.items():
        assert rate <= 1.02 * drives[joint].velocity, joint
    service = 'controller_manager/list_controllers'
    asked = world.node.create_client(ListControllers, service)
    world.wait(service, asked.service_is_ready)
    answer = asked.call_async(ListControllers.Request())
    world.wait('the controllers', answer.done)
    claimed = {each.name: each.claimed_interfaces for each in answer.result().controller}
    for name, moved in joints.items():
        assert {claim.split('/')[0] for claim in claimed[f'{name}_controller']} == set(moved)
