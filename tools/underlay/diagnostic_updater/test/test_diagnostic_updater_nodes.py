# SPDX-License-Identifier: Apache-2.0
"""Diagnostics that a node publishes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from diagnostic_updater import (
    DiagnosedPublisher,
    DiagnosticStatusWrapper,
    FrequencyStatusParam,
    HeaderlessTopicDiagnostic,
    TimeStampStatusParam,
    Updater,
)
import pytest
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import Range

Wait = Callable[[Callable[[], object]], None]


@pytest.fixture
def node() -> Iterator[Node]:
    """Return a node whose diagnostics come at once."""
    context = rclpy.Context()
    rclpy.init(context=context)
    made = Node('camera', context=context)
    yield made
    made.destroy_node()
    rclpy.shutdown(context=context)


@pytest.fixture
def got(node: Node) -> list[DiagnosticStatus]:
    """Return a list that gets all statuses."""
    statuses: list[DiagnosticStatus] = []
    node.create_subscription(
        DiagnosticArray, '/diagnostics', lambda array: statuses.extend(array.status), 10
    )
    return statuses


@pytest.fixture
def wait(node: Node) -> Iterator[Wait]:
    """Return a function that spins the node until a condition is true."""
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(node)

    def until(condition: Callable[[], object]) -> None:
        end = time.monotonic() + 30.0
        while not condition():
            assert time.monotonic() < end, 'It did not become true'
            executor.spin_once(timeout_sec=0.05)

    yield until
    executor.shutdown()


def connected(updater: Updater, wait: Wait) -> Updater:
    """Return the updater once its topic has the subscription."""
    wait(updater.publisher.get_subscription_count)
    return updater


def warm(status: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
    """Report a temperature."""
    status.summary(DiagnosticStatus.WARN, 'warm')
    status.add('temperature', 71)
    return status


def test_tasks_are_published_periodically(
    node: Node, got: list[DiagnosticStatus], wait: Wait
) -> None:
    """The status has the name of the node and the task, the ID, and what the task reports."""
    updater = connected(Updater(node, period=0.05), wait)
    updater.setHardwareID('camera 17')
    updater.add('temperature', warm)
    wait(lambda: len([each for each in got if each.message == 'warm']) >= 3)
    status = got[-1]
    assert status.name == 'camera: temperature'
    assert status.hardware_id == 'camera 17'
    assert status.level == DiagnosticStatus.WARN
    assert [(each.key, each.value) for each in status.values] == [('temperature', '71')]


def test_new_tasks_and_broadcasts(node: Node, got: list[DiagnosticStatus], wait: Wait) -> None:
    """A new task is announced; a broadcast is published for each task, without running it."""
    updater = connected(Updater(node, period=1000.0), wait)
    updater.add('temperature', warm)
    wait(lambda: len(got) == 1)
    assert (got[0].level, got[0].message) == (DiagnosticStatus.OK, 'The node is starting up')
    updater.broadcast(DiagnosticStatus.STALE, 'switched off')
    wait(lambda: len(got) == 2)
    assert (got[1].level, got[1].message) == (DiagnosticStatus.STALE, 'switched off')
    updater.update()  # less than a period has passed
    updater.force_update()
    wait(lambda: len(got) == 3)
    assert got[2].message == 'warm'


def test_the_parameter_is_the_period(node: Node, got: list[DiagnosticStatus], wait: Wait) -> None:
    """A change takes effect at once; periods that are not positive are refused."""
    updater = connected(Updater(node, period=1000.0), wait)
    updater.add('temperature', warm)
    assert node.get_parameter('diagnostic_updater.period').value == 1000.0
    refused = node.set_parameters([Parameter('diagnostic_updater.period', value=0.0)])
    assert 'greater than 0' in refused[0].reason
    assert node.set_parameters([Parameter('diagnostic_updater.period', value=0.05)])[0].successful
    wait(lambda: len([each for each in got if each.message == 'warm']) >= 3)
    assert updater.period == 0.05
    assert Updater(node).period == 0.05


def test_topics_are_watched(node: Node, got: list[DiagnosticStatus], wait: Wait) -> None:
    """A publisher that is watched publishes, and its frequency and ages are reported."""
    updater = connected(Updater(node, period=1000.0), wait)
    often = FrequencyStatusParam({'min': 0.0, 'max': float('inf')})
    watched = DiagnosedPublisher(
        node.create_publisher(Range, 'range', 10), updater, often, TimeStampStatusParam()
    )
    counted = HeaderlessTopicDiagnostic('clicks', updater, often)
    ranges: list[Range] = []
    node.create_subscription(Range, 'range', ranges.append, 10)
    wait(watched.publisher.get_subscription_count)
    message = Range()
    message.header.stamp = node.get_clock().now().to_msg()
    watched.publish(message)
    counted.tick()
    wait(lambda: len(ranges) == 1 and len(got) == 2)
    updater.force_update()
    wait(lambda: len(got) == 4)
    names = [each.name for each in got[2:]]
    assert names == ['camera: /range topic status', 'camera: clicks topic status']
    assert [each.level for each in got[2:]] == [DiagnosticStatus.OK, DiagnosticStatus.OK]
    keys = {each.key for each in got[2].values}
    assert {'Events in window', 'Earliest timestamp delay'} <= keys
    counted.clear_window()
    updater.force_update()
    wait(lambda: len(got) == 6)
    assert got[5].message == 'No events recorded.'
