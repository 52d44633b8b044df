# SPDX-License-Identifier: Apache-2.0
"""Check what nodes say of themselves."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from humanoid_common.diagnostics import Diagnostics, Level, PartStatus
from humanoid_common.qos import STATE
from humanoid_common.testing.ros import ros_sandbox
from rclpy.node import Node


def test_the_parts_of_a_node_are_published() -> None:
    """Each with the name of the node, in its namespace; anew at each time."""
    received: list[DiagnosticArray] = []
    asked: list[int] = []

    def report() -> list[PartStatus]:
        asked.append(0)
        return [
            PartStatus('ears', 'Listening', values={'heard': len(asked)}),
            PartStatus('voice', 'Hoarse', Level.WARN),
        ]

    with ros_sandbox() as ros:
        node = ros.start(lambda **options: Node('talker', namespace='robot', **options))
        watch = ros.observer()
        watch.create_subscription(DiagnosticArray, '/robot/diagnostics', received.append, STATE)
        diagnostics = Diagnostics(node, report)
        ros.wait_until(lambda: len(received) > 1, what='two messages')
        del diagnostics
    ears, voice = received[-1].status
    assert ears.name == 'robot/talker: ears' and ears.message == 'Listening'
    assert ears.level == DiagnosticStatus.OK and voice.level == DiagnosticStatus.WARN
    assert [(each.key, each.value) for each in ears.values] == [('heard', str(len(received)))]
    assert voice.message == 'Hoarse' and received[-1].header.stamp.sec > 0


def test_stamps_of_another_time() -> None:
    """The time of a world that a node hosts is no clock of ROS."""
    received: list[DiagnosticArray] = []
    with ros_sandbox() as ros:
        node = ros.start(lambda **options: Node('world', **options))
        watch = ros.observer()
        watch.create_subscription(DiagnosticArray, 'diagnostics', received.append, STATE)
        diagnostics = Diagnostics(node, lambda: [PartStatus('loop', 'runs')], lambda: 3.25)
        ros.wait_until(lambda: received, what='a message')
        del diagnostics
    stamp = received[0].header.stamp
    assert (stamp.sec, stamp.nanosec) == (3, 250_000_000)
