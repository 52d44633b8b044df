# SPDX-License-Identifier: Apache-2.0
"""The examples, with each other."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
import threading
import time
from types import ModuleType
from typing import Any

from examples_rclpy_executors.custom_callback_group import ThrottledTalker
from examples_rclpy_executors.custom_executor import PriorityExecutor
from examples_rclpy_guard_conditions.trigger_guard_condition import wait_for_trigger
from examples_rclpy_minimal_action_server.server import MinimalActionServer
from examples_rclpy_minimal_action_server.server_defer import DeferringActionServer
from examples_rclpy_minimal_action_server.server_queue_goals import QueueingActionServer
from examples_rclpy_minimal_action_server.server_single_goal import SingleGoalActionServer
from examples_rclpy_pointcloud_publisher.pointcloud_publisher import PointCloudPublisher
import numpy as np
from publisher_probe import Programs, TIMEOUT_S
import pytest
from rclpy.node import Node
from sensor_msgs.msg import PointCloud2
from sensor_msgs_py import point_cloud2
import yaml

PACKAGE = Path(__file__).parents[1]
PACKAGES = yaml.safe_load((PACKAGE / 'packages.yaml').read_text())
SEQUENCE = "array('i', [0, 1, 1, 2, 3, 5, 8, 13, 21, 34, 55])"
FAST_S = 0.01


def example(package: str, name: str) -> ModuleType:
    """Import the module of an executable."""
    assert name in PACKAGES[f'examples_rclpy_{package}']['executables']
    return import_module(f'examples_rclpy_{package}.{name}')


def test_executables() -> None:
    """Each module is an executable with a `main`, apart from what others share."""
    for name, package in PACKAGES.items():
        modules = {path.stem for path in (PACKAGE / name).glob('*.py')} - {'__init__', 'program'}
        assert modules == {*package['executables']}
        assert all(callable(import_module(f'{name}.{each}').main) for each in modules)


@pytest.mark.parametrize(
    ('publisher', 'subscriber'),
    [
        ('publisher_member_function', 'subscriber_member_function'),
        ('publisher_local_function', 'subscriber_lambda'),
        ('publisher_old_school', 'subscriber_old_school'),
    ],
)
def test_topics(stage: Any, publisher: str, subscriber: str) -> None:
    """The subscriber hears the publisher."""
    stage.main(example('minimal_subscriber', subscriber))
    stage.main(example('minimal_publisher', publisher))
    stage.until_logged('[minimal_subscriber]: I heard: "Hello World: ')
    assert '[minimal_publisher]: Publishing: "Hello World: 0"' in stage.log


@pytest.mark.parametrize(
    ('service', 'client'),
    [
        ('service', 'client'),
        ('service', 'client_async'),
        ('service_member_function', 'client_async_callback'),
        ('service_member_function', 'client_async_member_function'),
    ],
)
def test_services(stage: Any, service: str, client: str) -> None:
    """The client gets the sum, and ends."""
    end = stage.main(example('minimal_client', client))
    stage.main(example('minimal_service', service))
    stage.until(end.done, 'no end')
    assert '[minimal_service]: Incoming request\na: 41 b: 1' in stage.log
    assert 'Result of add_two_ints: for 41 + 1 = 42' in stage.log


@pytest.mark.parametrize('kind', [MinimalActionServer, DeferringActionServer])
def test_an_action(stage: Any, kind: type[MinimalActionServer]) -> None:
    """The client gets feedback and the result; a server may execute the goal later."""
    is_late = kind is DeferringActionServer
    stage.add(kind(period_s=FAST_S, **{'delay_s': FAST_S} if is_late else {}))
    stage.until(stage.main(example('minimal_action_client', 'client')).done, 'no end')
    assert "Received feedback: array('i', [0, 1, 1])" in stage.log
    assert f'Goal succeeded! Result: {SEQUENCE}' in stage.log
    assert ('Deferring execution...' in stage.log) == is_late


def test_an_action_is_canceled(stage: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """The server stops working on the goal."""
    client = example('minimal_action_client', 'client_cancel')
    monkeypatch.setattr(client, 'PATIENCE_S', FAST_S)
    stage.add(MinimalActionServer())
    stage.until(stage.main(client).done, 'no end')
    assert 'Goal successfully canceled' in stage.log
    stage.until_logged('[minimal_action_server]: Goal canceled')


@pytest.mark.parametrize(
    ('kind', 'log'),
    [
        (QueueingActionServer, ['Goal put in the queue', 'Next goal pulled from the queue']),
        (SingleGoalActionServer, ['Aborting previous goal', 'Goal failed with status: 6']),
    ],
)
def test_two_goals(stage: Any, kind: type[MinimalActionServer], log: list[str]) -> None:
    """The second goal waits for the first one, or ends it."""
    stage.add(kind(period_s=FAST_S))
    end = stage.main(example('minimal_action_client', 'client_asyncio'))
    stage.until(end.done, 'no end')
    assert all(text in stage.log for text in log)
    successes = 2 if kind is QueueingActionServer else 1
    assert stage.log.count(f'Goal succeeded! Result: {SEQUENCE}') == successes


def test_tokens_limit_callbacks(stage: Any) -> None:
    """A callback needs a token; there are never more than the bucket holds."""
    group = ThrottledTalker().group
    timer = object()
    assert [group.beginning_execution(timer) for _ in range(11)] == [True] * 10 + [False]
    assert not group.can_execute(timer)
    group.ending_execution(timer)
    group.timer_callback()
    assert group.can_execute(timer) and group.beginning_execution(timer)
    for _ in range(20):
        group.timer_callback()
    assert group.bucket == 10


def test_important_callbacks_do_not_wait(stage: Any) -> None:
    """A callback of an important node runs while that of another node is busy."""
    executor = PriorityExecutor()
    other, important = Node('other'), Node('important')
    is_busy, is_over = threading.Event(), threading.Event()

    def be_busy() -> None:
        is_busy.set()
        is_over.wait(TIMEOUT_S)

    other.create_timer(FAST_S, be_busy)
    important.create_timer(FAST_S, lambda: is_busy.is_set() and is_over.set())
    executor.add_node(other)
    executor.add_high_priority_node(important)
    end_s = time.monotonic() + TIMEOUT_S
    while not is_over.is_set():
        assert time.monotonic() < end_s
        executor.spin_once(timeout_sec=0.05)
    executor.shutdown()
    for node in (other, important):
        node.destroy_node()


def test_a_thread_triggers_a_guard_condition(stage: Any) -> None:
    """Its callback is called by the executor."""
    node = Node('guarded')
    wait_for_trigger(node, delay_s=0.0)
    assert '[guarded]: Guard callback called!' in stage.log
    node.destroy_node()


def test_point_cloud(stage: Any) -> None:
    """It has the fields that RViz shows, and moves."""
    clouds: list[PointCloud2] = []
    node = PointCloudPublisher()
    node.create_subscription(PointCloud2, 'test_cloud', clouds.append, 1)
    stage.add(node)
    stage.until(lambda: len(clouds) > 1, 'no clouds')
    first, second = (point_cloud2.read_points(each) for each in clouds[:2])
    assert first.shape == (10_000,) and clouds[0].header.frame_id == 'map'
    assert first['z'] == pytest.approx(0.3 * first['intensity'], abs=1e-6)
    assert np.abs(first['intensity']).max() <= 1.0
    assert not np.array_equal(first['z'], second['z'])


def test_a_program_with_threads(programs: Programs) -> None:
    """It ends in order with Ctrl-C."""
    program = programs.start('examples_rclpy_executors.callback_group')
    end_s = time.monotonic() + TIMEOUT_S
    while 'I heard: ' not in program.output:
        assert time.monotonic() < end_s, program.output
        time.sleep(0.05)
    assert program.end() == 0
    assert 'Traceback' not in program.output
