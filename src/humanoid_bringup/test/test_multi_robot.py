# SPDX-License-Identifier: Apache-2.0
"""Check the launch file of several robots."""

from __future__ import annotations

from pathlib import Path
import signal

from humanoid_common.testing.launching import (
    argument_defaults,
    load_launch_file,
    running_launch_file,
    undescribed_arguments,
)
from humanoid_common.testing.ros import ros_sandbox
import pytest
from sensor_msgs.msg import JointState

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'multi_robot.launch.py'


def test_arguments() -> None:
    """The argument has a default and a description."""
    description = load_launch_file(LAUNCH_FILE)
    assert argument_defaults(description) == {'robots': '3'}
    assert undescribed_arguments(description) == []


def test_each_robot_publishes_by_itself() -> None:
    """Every robot has a topic of its own, with one publisher that sends commands."""
    topics = [f'/robot{index}/joint_commands' for index in (1, 2, 3)]
    received: set[str] = set()
    with ros_sandbox() as ros, running_launch_file(LAUNCH_FILE) as program:
        observer = ros.observer()
        for topic in topics:
            observer.create_subscription(
                JointState, topic, lambda _, topic=topic: received.add(topic), 10
            )
        ros.wait_until(lambda: received == set(topics), 20.0, 'commands of all robots')
        assert [observer.count_publishers(topic) for topic in topics] == [1, 1, 1]
        assert observer.count_publishers('/joint_commands') == 0
        report = program.stop(signal.SIGINT)
    assert report.status == 0 and 'Traceback' not in report.output


@pytest.mark.parametrize('count', ['0', 'x', '1000'])
def test_wrong_count(count: str) -> None:
    """A count that makes no fleet ends the launch with a sentence."""
    with ros_sandbox(), running_launch_file(LAUNCH_FILE, f'robots:={count}') as program:
        report = program.wait_for_exit()
    assert report.status == 1
    assert f"Launch argument 'robots' is '{count}', but must be a whole number" in report.output
