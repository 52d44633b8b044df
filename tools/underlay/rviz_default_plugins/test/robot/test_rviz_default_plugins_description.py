# SPDX-License-Identifier: Apache-2.0
"""Descriptions that real publishers send."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import time
from typing import Any

from domain_coordinator import domain_id
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rviz_default_plugins.displays.robot_model import RobotModel
from rviz_default_plugins.robot.description import read_description
from stage import Stage
from std_msgs.msg import String

TIMEOUT_S = 100.0
URDF = '<robot name="r"><link name="base"/></robot>'


@pytest.fixture
def context(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """Return ROS in a domain of its own."""
    monkeypatch.setitem(os.environ, 'ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    with domain_id() as domain:
        context = rclpy.Context()
        context.init(domain_id=domain)
        yield context
        context.try_shutdown()


@pytest.mark.parametrize('durability', ['TRANSIENT_LOCAL', 'VOLATILE'])
def test_description_comes(stage: Stage, context: Any, durability: str) -> None:
    """A description is heard from who keeps it for late comers, and from who does not."""
    other = rclpy.create_node('other', context=context)
    own = rclpy.create_node('own', context=context)
    qos = QoSProfile(depth=1, durability=DurabilityPolicy[durability])
    publisher = other.create_publisher(String, '/robot_description', qos)
    publisher.publish(String(data=URDF))
    object.__setattr__(stage.context, 'node', own)
    stage.show(RobotModel)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(own)
    end_s = time.monotonic() + TIMEOUT_S
    while stage.node_at('/display_0/base') is None:
        assert time.monotonic() < end_s, 'no description came'
        if durability == 'VOLATILE':
            publisher.publish(String(data=URDF))
        executor.spin_once(timeout_sec=0.1)
    stage.displays.pop().stop()
    executor.shutdown()
    own.destroy_node()
    other.destroy_node()


def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    """A description is read from a file, and not from what might never end."""
    os.mkfifo(tmp_path / 'pipe.urdf')
    for name in (str(tmp_path / 'pipe.urdf'), 'file:///dev/zero'):
        with pytest.raises(ValueError, match='is not a regular file'):
            read_description(name)
