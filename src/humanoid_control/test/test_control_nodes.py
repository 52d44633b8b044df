# SPDX-License-Identifier: Apache-2.0
"""Check the nodes in this process."""

from __future__ import annotations

from collections.abc import Iterator
import math
from statistics import median

from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.joint_controller import HumanoidJointController
from humanoid_control.sensor_processor import SensorProcessor
import pytest
from rcl_interfaces.msg import Log
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState

TOPIC = 'joint_commands'


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def commands_of(ros: RosSandbox, topic: str = TOPIC) -> list[JointState]:
    """Collect the commands on a topic."""
    commands: list[JointState] = []
    ros.observer().create_subscription(JointState, topic, commands.append, 100)
    return commands


def logs_of(ros: RosSandbox) -> list[str]:
    """Collect the log messages."""
    logs: list[str] = []
    ros.observer().create_subscription(Log, '/rosout', lambda log: logs.append(log.msg), 100)
    return logs


def test_command(ros: RosSandbox) -> None:
    """A command names the joints and carries position, velocity, effort and time."""
    commands = commands_of(ros)
    ros.start(HumanoidJointController)
    ros.wait_until(lambda: len(commands) > 5, what='commands')
    first, last = commands[0], commands[-1]
    assert list(last.name) == ['left_shoulder', 'left_elbow', 'right_shoulder', 'right_elbow']
    assert list(last.effort) == [0.0] * 4
    assert last.position[2] == pytest.approx(-last.position[0])
    assert math.hypot(last.position[0], last.velocity[0]) == pytest.approx(0.5)
    assert last.header.stamp.sec > 0 and last.position[0] > first.position[0]


def test_rate_changes_without_a_jump(ros: RosSandbox) -> None:
    """After a change of the rate the commands come faster, and the motion goes on."""
    commands = commands_of(ros)
    slow = {'rate_hz': 5.0, 'frequencies_rad_s': [0.1] * 4}
    node = ros.start(HumanoidJointController, slow)
    ros.wait_until(lambda: len(commands) >= 2, what='commands')
    assert node.set_parameters([Parameter('rate_hz', value=100.0)])[0].successful
    ros.wait_until(lambda: len(commands) >= 60, what='faster commands')
    positions_rad = [command.position[0] for command in commands]
    steps_rad = [later - earlier for earlier, later in zip(positions_rad, positions_rad[1:])]
    # The joint moves at 0.05 rad/s for some seconds: 0.5 mrad in the 10 ms between commands.
    assert 0.0003 < median(steps_rad) < 0.00051
    assert min(steps_rad) > 0.0


def test_refused_change(ros: RosSandbox) -> None:
    """Lists that do not fit together are refused with the reason."""
    node = ros.start(HumanoidJointController)
    result = node.set_parameters([Parameter('joints', value=['left_shoulder'])])[0]
    assert not result.successful and 'atomic request' in result.reason


def test_joints_change_together(ros: RosSandbox) -> None:
    """All lists together may change the number of joints."""
    commands = commands_of(ros)
    node = ros.start(HumanoidJointController)
    result = node.set_parameters_atomically(
        [
            Parameter('joints', value=['head_yaw']),
            Parameter('amplitudes_rad', value=[0.1]),
            Parameter('frequencies_rad_s', value=[1.0]),
            Parameter('phases_rad', value=[0.0]),
        ]
    )
    assert result.successful
    ros.wait_until(lambda: bool(commands) and list(commands[-1].name) == ['head_yaw'])
    assert len(commands[-1].position) == len(commands[-1].effort) == 1


def test_namespace(ros: RosSandbox) -> None:
    """In a namespace, the topic is that of the namespace."""
    commands = commands_of(ros, '/robot1/joint_commands')
    ros.start(HumanoidJointController, namespace='robot1')
    ros.wait_until(lambda: bool(commands), what='commands in the namespace')
    assert len(commands[0].name) == 4


def test_sensor_processor(ros: RosSandbox) -> None:
    """The first joint is logged, also when an empty message came before."""
    logs = logs_of(ros)
    ros.start(SensorProcessor)
    talker = ros.observer()
    publisher = talker.create_publisher(JointState, TOPIC, 10)
    ros.wait_until(lambda: publisher.get_subscription_count() == 1, what='the subscription')
    publisher.publish(JointState())
    publisher.publish(JointState(name=['left_shoulder'], position=[0.0411]))
    ros.wait_until(lambda: 'left_shoulder: 0.041 rad' in logs, what='the report')
    assert 'Sensor Processor started' in logs
