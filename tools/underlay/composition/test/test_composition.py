# SPDX-License-Identifier: Apache-2.0
"""The components, alone, in the programs, and in a container."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from composition.components import Client, Server
from example_interfaces.srv import AddTwoInts
from launch import LaunchContext
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch_ros.actions import ComposableNodeContainer
from publisher_probe import Probe, Programs
import pytest
from rclpy.executors import SingleThreadedExecutor
from std_msgs.msg import String

PACKAGE = Path(__file__).parents[1]
COMPONENTS = (PACKAGE / 'resource/rclcpp_components/composition').read_text().splitlines()


def test_components() -> None:
    """The five of the tutorial are there."""
    names = []
    for line in COMPONENTS:
        name, _, place = line.partition(';')
        module, _, attribute = place.partition(':')
        assert callable(getattr(import_module(module), attribute))
        names.append(name)
    kinds = ('Client', 'Listener', 'NodeLikeListener', 'Server', 'Talker')
    assert names == [f'composition::{kind}' for kind in kinds]


def test_client_and_server(probe: Probe, capfd: pytest.CaptureFixture[str]) -> None:
    """The client gets sums, also after a server came late."""
    executor = SingleThreadedExecutor(context=probe.node.context)
    client = Client(context=probe.node.context)
    executor.add_node(client)
    client.on_timer()
    assert 'Service not available after waiting' in capfd.readouterr().err
    server = Server(context=probe.node.context)
    executor.add_node(server)
    log = ''

    def is_answered() -> bool:
        nonlocal log
        executor.spin_once(timeout_sec=0.05)
        log += capfd.readouterr().err
        return 'Got result: [5]' in log

    probe.until(is_answered, 'no sum')
    assert '[Server]: Incoming request: [a: 2, b: 3]' in log
    response = server.add_two_ints_callback(
        AddTwoInts.Request(a=2**63 - 1, b=1), AddTwoInts.Response()
    )
    assert response.sum == -(2**63)
    executor.shutdown()
    for node in (client, server):
        node.destroy_node()


@pytest.mark.parametrize('name', ['manual', 'linktime'])
def test_programs(probe: Probe, programs: Programs, name: str) -> None:
    """All four run in one process, and it ends with Ctrl-C."""
    heard = probe.listen(String, '/chatter')
    program = programs.start(f'composition.{name}_composition')
    probe.until(lambda: heard, 'nobody talks')
    for text in ('I heard: [Hello World: ', 'Got result: [5]', '[Server]: Incoming request'):
        probe.until(lambda text=text: text in program.output, f'it does not say {text}')
    assert program.end() == 0
    assert 'Traceback' not in program.output


def test_launch_file() -> None:
    """It loads the talker and the listener into a container."""
    path = str(PACKAGE / 'launch' / 'composition_demo.launch.py')
    description = AnyLaunchDescriptionSource(path).get_launch_description(LaunchContext())
    (container,) = description.entities
    assert isinstance(container, ComposableNodeContainer)
