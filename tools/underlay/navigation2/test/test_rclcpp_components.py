# SPDX-License-Identifier: Apache-2.0
"""Containers: loading, listing and unloading components, in process and as programs."""

from __future__ import annotations

import os
from pathlib import Path
import signal
import subprocess
import sys
from typing import Any

from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from nav2_msgs.action import Wait
import pytest
from rcl_interfaces.srv import GetParameters
from rclcpp_components.container import ComponentContainer
from rclpy.action import ActionClient
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock

sys.path.insert(0, str(Path(__file__).parent))  # tests are imported by their files
from component_examples import PACKAGE, register  # noqa: E402, I100


class Box:
    """A container, and its services."""

    def __init__(self, ros: Any) -> None:
        self.ros = ros

    def load(self, plugin: str, package: str = PACKAGE, **fields: Any) -> Any:
        """Ask for a component."""
        request = LoadNode.Request(package_name=package, plugin_name=f'{PACKAGE}::{plugin}')
        for name, value in fields.items():
            setattr(request, name, value)
        return self.ros.call(LoadNode, '/box/_container/load_node', request)

    def unload(self, uid: int) -> Any:
        """Ask for a component to be unloaded."""
        request = UnloadNode.Request(unique_id=uid)
        return self.ros.call(UnloadNode, '/box/_container/unload_node', request)

    def names(self) -> dict[int, str]:
        """Return the names of what is loaded by their numbers."""
        answer = self.ros.call(ListNodes, '/box/_container/list_nodes')
        return dict(zip(answer.unique_ids, answer.full_node_names, strict=True))

    def activate(self, name: str) -> None:
        """Configure and activate a node."""
        for transition in (Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE):
            request = ChangeState.Request(transition=Transition(id=transition))
            assert self.ros.call(ChangeState, f'{name}/change_state', request).success

    def wait_for_nodes(self, *names: str) -> None:
        """Wait until these and no other nodes are in the graph, beside the test's own."""
        node = self.ros.nodes[0]
        expected = {'box', 'tester', *names}
        self.ros.wait_until(
            lambda: set(node.get_node_names()) == expected, what=f'the nodes {names}'
        )


@pytest.fixture(autouse=True)
def _package(tmp_path, monkeypatch):
    register(tmp_path)
    for name, path in (('AMENT_PREFIX_PATH', tmp_path), ('PYTHONPATH', Path(__file__).parent)):
        monkeypatch.setenv(name, f'{path}{os.pathsep}{os.environ.get(name, "")}')


@pytest.fixture(params=[False, True], ids=['shared', 'isolated'])
def box(ros, request):
    """Run a container in this process, of both kinds."""
    ros.node()
    ros.make(ComponentContainer, node_name='box', is_isolated=request.param)
    return Box(ros)


@pytest.fixture
def shared_box(ros):
    """Run a container whose components share a thread."""
    ros.node()
    ros.make(ComponentContainer, node_name='box')
    return Box(ros)


def test_load_list_unload(box):
    """Components get numbers; what is unloaded leaves the graph at once."""
    first, second = box.load('Talker'), box.load('Worker', node_name='other')
    assert (first.success, first.full_node_name, first.unique_id) == (True, '/talker', 1)
    assert (second.success, second.full_node_name, second.unique_id) == (True, '/other', 2)
    box.wait_for_nodes('talker', 'other')
    assert box.names() == {1: '/talker', 2: '/other'}
    assert box.unload(1).success
    assert box.names() == {2: '/other'}
    box.wait_for_nodes('other')
    assert box.unload(2).success
    box.wait_for_nodes()
    assert box.load('Talker').unique_id == 3
    answer = box.unload(1)
    assert not answer.success and answer.error_message == 'No node found with unique_id: 1'


def test_what_a_component_is_given(box):
    """Name, namespace, remappings, parameters and the level of its log."""
    answer = box.load(
        'Talker',
        node_name='speaker',
        node_namespace='/left',
        log_level=10,
        remap_rules=['chatter:=said'],
        parameters=[Parameter('number', value=5).to_parameter_msg()],
    )
    assert answer.full_node_name == '/left/speaker'
    node = box.ros.nodes[0]
    box.ros.wait_until(lambda: '/left/said' in dict(node.get_topic_names_and_types()))
    request = GetParameters.Request(names=['number'])
    values = box.ros.call(GetParameters, '/left/speaker/get_parameters', request).values
    assert values[0].integer_value == 5


@pytest.mark.parametrize(
    ('plugin', 'package', 'sentence'),
    [
        ('Raises', PACKAGE, 'threw an exception: RuntimeError: no such luck'),
        ('Refuses', PACKAGE, 'There is no map.'),
        ('Talkr', PACKAGE, f"Did you mean '{PACKAGE}::Talker'?"),
        ('Talker', 'no_such_package', "Could not find the package 'no_such_package'"),
        ('Talker', 'empty_components', "'empty_components' registers no components"),
        ('NoModule', PACKAGE, 'cannot be imported'),
        ('NoClass', PACKAGE, 'cannot be imported'),
        ('OfCpp', PACKAGE, 'is a C++ library'),
    ],
)
def test_what_cannot_be_loaded(shared_box, plugin, package, sentence):
    """The answer says why; nothing is left behind, and the container goes on."""
    answer = shared_box.load(plugin, package)
    assert not answer.success and sentence in answer.error_message
    assert shared_box.load('Talker').success
    shared_box.wait_for_nodes('talker')


def test_two_of_a_name(shared_box, capfd):
    """Both are loaded, which is said, and each is unloaded by its number."""
    assert [shared_box.load('Talker').unique_id for _ in range(2)] == [1, 2]
    assert "two nodes named '/talker'" in capfd.readouterr().err
    assert shared_box.unload(1).success
    assert shared_box.names() == {2: '/talker'}


def test_unloading_with_a_goal(box):
    """The client hears of the end, and nothing crashes, however often it is done."""
    ros = box.ros
    client = ActionClient(ros.nodes[0], Wait, 'wait')
    goal = Wait.Goal()
    goal.time.sec = 100
    for _ in range(5):
        uid = box.load('Worker').unique_id
        box.activate('/worker')
        ros.wait_until(client.server_is_ready)
        sent = client.send_goal_async(goal)
        ros.wait_until(sent.done)
        end = sent.result().get_result_async()
        client.send_goal_async(goal)
        assert box.unload(uid).success
        ros.wait_until(end.done)
        box.wait_for_nodes()
    client.destroy()


def test_one_clock_for_all(shared_box):
    """Nodes with simulated time share one subscription, also those that are made later."""
    ros = shared_box.ros
    node = ros.nodes[0]
    simulated = [Parameter('use_sim_time', value=True).to_parameter_msg()]
    for name in ('a', 'b', 'c'):
        shared_box.load('Worker', node_name=name, parameters=simulated)
        request = GetParameters.Request(names=['use_sim_time'])
        values = ros.call(GetParameters, f'/{name}/get_parameters', request).values
        assert values[0].bool_value is True
    container = ros.nodes[1]
    workers = [each.node for each in container._components.values()]
    # What listens to transforms is made when they are asked for first.
    shared_by = [worker.transforms.node for worker in workers]
    assert len(set(shared_by)) == 1
    ros.wait_until(lambda: node.count_subscribers('/clock') == 1)
    clock = node.create_publisher(Clock, '/clock', 1)
    message = Clock()

    def is_told(second: int) -> bool:
        message.clock.sec = second
        clock.publish(message)
        told = {each.get_clock().now().nanoseconds for each in (*workers, shared_by[0])}
        return told == {second * 10**9}

    ros.wait_until(lambda: is_told(7), what='the time')
    assert shared_box.unload(1).success
    workers.pop(0)
    ros.wait_until(lambda: is_told(9), what='the time after the first node has gone')
    assert node.count_subscribers('/clock') == 1


def test_transforms_survive_the_node_that_asked_first(box):
    """Its listener is run for the others when it is unloaded, and ends with the last."""
    container = box.ros.nodes[1]
    for name in ('a', 'b'):
        box.load('Worker', node_name=name)
    # No variable may keep a node for longer than the container does.
    listener = container._components[1].node.transforms.node
    assert container._components[2].node.transforms.node is listener
    assert box.unload(1).success
    assert listener.executor is not None
    box.wait_for_nodes('b', 'transform_listener')
    assert box.unload(2).success
    del listener
    box.wait_for_nodes()


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('kind', ['', '_mt', '_isolated'])
def test_signals(ros, tmp_path, kind, number):
    """Each program ends with status 0 and without a traceback, with components loaded."""
    ros.node()
    program = (
        f'import sys; import rclcpp_components.container as c; sys.exit(c.run_container{kind}())'
    )
    log = tmp_path / 'log.txt'
    with log.open('w') as file:
        process = subprocess.Popen(
            [sys.executable, '-c', program, '--ros-args', '-r', '__node:=box'],
            stdout=file,
            stderr=file,
            env={**os.environ, 'ROS_DOMAIN_ID': str(ros.context.get_domain_id())},
        )
    try:
        box = Box(ros)
        assert box.load('Talker').success
        assert box.load('Worker').success
        box.activate('/worker')
        process.send_signal(number)
        assert process.wait(20.0) == 0, log.read_text()
    finally:
        process.kill()
        process.wait()
    assert 'Traceback' not in log.read_text()
