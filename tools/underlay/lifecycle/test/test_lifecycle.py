# SPDX-License-Identifier: Apache-2.0
"""The talker in each of its states, its listener, and the client that leads it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from launch import LaunchContext
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch_ros.actions import LifecycleNode
from lifecycle import lifecycle_service_client
from lifecycle.lifecycle_listener import LifecycleListener
from lifecycle.lifecycle_service_client import LifecycleServiceClient
from lifecycle.lifecycle_talker import LifecycleTalker
from lifecycle_msgs.srv import ChangeState, GetState
from publisher_probe import Probe, Programs
import pytest
from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros.executing import make_executor

PACKAGE = Path(__file__).parents[1]


@pytest.fixture
def talker(probe: Probe) -> Iterator[LifecycleTalker]:
    """Return a talker that nobody spins."""
    node = LifecycleTalker(context=probe.node.context)
    yield node
    node.destroy_node()


def test_texts_are_published_only_while_it_is_active(
    probe: Probe, talker: LifecycleTalker, capfd: pytest.CaptureFixture[str]
) -> None:
    """From configured on it counts; the numbers go on."""
    heard = probe.listen(String, '/lifecycle_chatter')
    talker.trigger_configure()
    probe.until(lambda: talker.count_subscribers('/lifecycle_chatter'), 'nobody listens')
    talker.publish()
    talker.trigger_activate()
    talker.publish()
    probe.until(lambda: heard, 'nothing was heard')
    assert [each.data for each in heard] == ['Lifecycle HelloWorld #2']
    talker.trigger_deactivate()
    talker.publish()
    talker.trigger_cleanup()
    assert not [each for each in talker.publishers if 'chatter' in each.topic_name]
    talker.trigger_shutdown()
    log = capfd.readouterr().err
    assert log.count('is currently inactive. Messages are not published.') == 2
    assert 'is active. Publishing: [Lifecycle HelloWorld #2]' in log
    for name in ('configure', 'activate', 'deactivate', 'cleanup', 'shutdown'):
        assert f'on_{name}(' in log


def test_the_client_leads_the_talker(
    probe: Probe,
    programs: Programs,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    """Through all states to the last one, as the listener hears."""
    monkeypatch.setattr(lifecycle_service_client, 'PAUSE_S', 0.5)
    talker = programs.start('lifecycle.lifecycle_talker')
    executor = make_executor(probe.node.context)
    options: Any = {'context': probe.node.context}
    client, listener = LifecycleServiceClient(**options), LifecycleListener(**options)
    for node in (client, listener):
        executor.add_node(node)
    task = executor.create_task(client.lead)

    def is_done() -> bool:
        executor.spin_once(timeout_sec=0.05)
        return task.done()

    probe.until(is_done, 'the client does not come to its end')
    assert task.exception() is None
    log = capfd.readouterr().err
    assert 'Failed' not in log and log.count('successfully triggered') == 7
    states = ('inactive', 'active', 'inactive', 'active', 'inactive', 'unconfigured')
    at = 0
    for state in states:
        at = log.index(f'has current state {state}.', at) + 1
    assert 'notify callback: Transition from state configuring to inactive' in log
    probe.until(lambda: 'on_shutdown(' in talker.output, 'it does not shut down')
    assert talker.end() == 0
    executor.shutdown()
    for node in (client, listener):
        node.destroy_node()


def test_a_transition_that_is_refused_ends_it(
    probe: Probe, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """The client says which one, and stops."""
    monkeypatch.setattr(lifecycle_service_client, 'PAUSE_S', 0.5)
    talker = Node('lc_talker', context=probe.node.context)
    for kind, name in ((GetState, 'get_state'), (ChangeState, 'change_state')):
        talker.create_service(kind, f'lc_talker/{name}', lambda request, response: response)
    client = LifecycleServiceClient(context=probe.node.context)
    executor = make_executor(probe.node.context)
    for node in (talker, client):
        executor.add_node(node)
    task = executor.create_task(client.lead)

    def is_done() -> bool:
        executor.spin_once(timeout_sec=0.05)
        return task.done()

    probe.until(is_done, 'the client does not come to its end')
    assert 'Failed to trigger transition 1' in capfd.readouterr().err
    executor.shutdown()
    for node in (client, talker):
        node.destroy_node()


def test_launch_file() -> None:
    """It starts the talker as a node with a lifecycle, and two others."""
    path = str(PACKAGE / 'launch' / 'lifecycle_demo.launch.py')
    description = AnyLaunchDescriptionSource(path).get_launch_description(LaunchContext())
    assert len(description.entities) == 3
    assert isinstance(description.entities[0], LifecycleNode)
