# SPDX-License-Identifier: Apache-2.0
"""Tests of the graph: names, reach, and real processes compared with what rclpy finds."""

from collections.abc import Iterator
import os
import signal
import subprocess
import sys
import time
from typing import Any

import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from ros2cli.graph.census import participant_ports, ports_in_table
from ros2cli.graph.graph import Graph
from ros2cli.graph.link import INCOMPLETE
from ros2cli.graph.reach import Reach, read_reach
from ros2cli.graph.watch import GraphWatch
from ros2cli.names import REQUEST, RESPONSE, ros_name, ros_type, service_type, TOPIC

DISCOVERY_S = 20.0
CHILD = """
import rclpy, time
rclpy.init()
node = rclpy.create_node('child')
node.create_publisher(__import__('std_msgs.msg').msg.String, 'children', 10)
print('ready', flush=True)
time.sleep(60)
"""


@pytest.fixture
def child(domain: int) -> Iterator[subprocess.Popen[str]]:
    """Run a process with a node and a publisher."""
    with subprocess.Popen(
        [sys.executable, '-c', CHILD], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout
        assert process.stdout.readline() == 'ready\n'
        yield process
        process.kill()


@pytest.fixture
def rclpy_node(robot: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> Iterator[Node]:
    """Create a node in the domain of the robot and wait until it has discovered everything."""
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    context = Context()
    rclpy.init(context=context, domain_id=int(robot['ROS_DOMAIN_ID']))
    node = rclpy.create_node('_observer', context=context, enable_rosout=False)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    end = time.monotonic() + DISCOVERY_S
    while not node.count_subscribers('/canned') and time.monotonic() < end:
        if len(node.get_node_names()) > 3 and node.count_services('/flip'):
            break
        executor.spin_once(timeout_sec=0.05)
    end = time.monotonic() + 2.0
    while time.monotonic() < end:
        executor.spin_once(timeout_sec=0.05)
    yield node
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown(context=context)


@pytest.fixture
def robot_graph(robot: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> Graph:
    """Return the graph of the robot's domain."""
    monkeypatch.setenv('ROS_DOMAIN_ID', robot['ROS_DOMAIN_ID'])
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    with GraphWatch() as watch:
        return watch.settled()


def names(graph: Graph) -> list[str]:
    """Return the names of the nodes, sorted."""
    return sorted(name for name, _ in graph.get_node_names_and_namespaces())


def without(own: Node, ends: list[Any]) -> list[str]:
    """Return what rclpy prints of endpoints, without those of a node."""
    return sorted(str(end) for end in ends if end.node_name != own.get_name())


def test_same_names_as_rclpy(rclpy_node: Node, robot_graph: Graph) -> None:
    """Nodes, topics and services are those that rclpy finds in some seconds."""
    expected = set(rclpy_node.get_node_names_and_namespaces()) - {('_observer', '/')}
    assert set(robot_graph.get_node_names_and_namespaces()) == expected
    topics = dict(rclpy_node.get_topic_names_and_types())
    assert dict(robot_graph.get_topic_names_and_types()) == topics
    services = dict(rclpy_node.get_service_names_and_types())
    own = {name for name in services if name.startswith('/_observer/')}
    found = dict(robot_graph.get_service_names_and_types())
    assert found == {name: services[name] for name in services.keys() - own}


def test_same_ends_as_rclpy(rclpy_node: Node, robot_graph: Graph) -> None:
    """Each end of each topic is described with the same words as rclpy's."""
    for topic, _ in robot_graph.get_topic_names_and_types():
        for kind in ('publishers', 'subscriptions'):
            read = f'get_{kind}_info_by_topic'
            expected = without(rclpy_node, getattr(rclpy_node, read)(topic))
            assert sorted(str(end) for end in getattr(robot_graph, read)(topic)) == expected
            count = 'count_publishers' if kind == 'publishers' else 'count_subscribers'
            assert getattr(robot_graph, count)(topic) == len(expected)


def test_same_ends_by_node_as_rclpy(rclpy_node: Node, robot_graph: Graph) -> None:
    """What each node publishes, subscribes to, offers and calls is what rclpy says."""
    for name, namespace in robot_graph.get_node_names_and_namespaces():
        for kind in ('publisher', 'subscriber', 'service', 'client'):
            read = f'get_{kind}_names_and_types_by_node'
            expected = sorted(getattr(rclpy_node, read)(name, namespace))
            assert getattr(robot_graph, read)(name, namespace) == expected


def test_watch_leaves_no_trace(rclpy_node: Node, robot_graph: Graph) -> None:
    """Others see neither a node nor a subscription of who only looks."""
    assert not [name for name in rclpy_node.get_node_names() if 'ros2cli' in name]
    assert rclpy_node.count_subscribers('/ros_discovery_info') == 0


def test_killed_node_is_gone_at_once(child: subprocess.Popen[str]) -> None:
    """A node that was killed is not listed, though its lease lasts for many seconds."""
    with GraphWatch() as watch:
        assert names(watch.settled()) == ['child']
        child.kill()
        child.wait()
        end = time.monotonic() + DISCOVERY_S
        while names(watch.updated()) and time.monotonic() < end:
            time.sleep(0.05)
        assert names(watch.graph) == []
    with GraphWatch() as watch:
        assert names(watch.settled()) == []


def test_stopped_process_is_told(
    child: subprocess.Popen[str], capfd: pytest.CaptureFixture[str]
) -> None:
    """A process that does not answer is waited for once, and then the graph may be incomplete."""
    os.kill(child.pid, signal.SIGSTOP)
    with GraphWatch(0.05) as watch:
        assert names(watch.settled()) == []
        assert names(watch.settled()) == []
        assert capfd.readouterr().err == f'{INCOMPLETE}\n'
        os.kill(child.pid, signal.SIGCONT)
        end = time.monotonic() + DISCOVERY_S
        while not names(watch.updated()) and time.monotonic() < end:
            time.sleep(0.05)
        assert names(watch.graph) == ['child']


def test_appearing_node_is_waited_for(domain: int) -> None:
    """A watch on an empty domain sees a node that starts later, and its topic."""
    from ros2cli.waiting import Patience

    def find(graph: Graph) -> int:
        return graph.count_publishers('/children')

    with GraphWatch() as watch:
        assert names(watch.settled()) == []
        with subprocess.Popen([sys.executable, '-c', CHILD], stdout=subprocess.PIPE) as process:
            assert watch.wait_for(find, Patience('a child'), DISCOVERY_S) == 1
            process.kill()


def test_name_that_is_not_there_yet_is_waited_for(domain: int) -> None:
    """What is looked for may appear within the spin time; what is never found ends the wait."""
    with GraphWatch(DISCOVERY_S) as watch:
        with subprocess.Popen([sys.executable, '-c', CHILD], stdout=subprocess.PIPE) as process:
            graph = watch.settled_with(lambda graph: graph.count_publishers('/children'))
            assert names(graph) == ['child']
            process.kill()
    with GraphWatch(0.01) as watch:
        assert names(watch.settled_with(lambda graph: False)) == []


def test_watch_after_a_pause(
    child: subprocess.Popen[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who has not looked for longer than others remember us asks everybody anew."""
    from ros2cli.graph import watch as module

    with GraphWatch() as watch:
        assert names(watch.settled()) == ['child']
        monkeypatch.setattr(module, 'LEASE_S', 0.0)
        time.sleep(0.01)
        watch.updated()
        monkeypatch.undo()
        assert names(watch.settled()) == ['child']


def test_topics_and_services_have_prefixes() -> None:
    """The names of DDS are turned into those of ROS, and what is not from ROS into nothing."""
    assert ros_name('rt/robot/joint_states') == (TOPIC, '/robot/joint_states')
    assert ros_name('rq/flipRequest') == (REQUEST, '/flip')
    assert ros_name('rr/flipReply') == (RESPONSE, '/flip')
    assert ros_name('rq/flip') is None
    assert ros_name('ros_discovery_info') is None
    assert ros_name('Square') is None
    assert ros_type('std_msgs::msg::dds_::String_') == 'std_msgs/msg/String'
    assert ros_type('ShapeType') == 'ShapeType'
    assert service_type('std_srvs::srv::dds_::SetBool_Request_') == 'std_srvs/srv/SetBool'
    assert service_type('std_srvs::srv::dds_::SetBool_Response_') == 'std_srvs/srv/SetBool'


@pytest.mark.parametrize(
    ('environment', 'expected'),
    [
        ({}, (0, 'SUBNET', ())),
        (
            {'ROS_DOMAIN_ID': '7', 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'localhost'},
            (7, 'LOCALHOST', ()),
        ),
        ({'ROS_LOCALHOST_ONLY': '1'}, (0, 'LOCALHOST', ())),
        ({'ROS_LOCALHOST_ONLY': '1', 'ROS_STATIC_PEERS': 'robot'}, (0, 'LOCALHOST', ())),
        (
            {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST', 'ROS_STATIC_PEERS': 'robot'},
            (0, 'LOCALHOST', ()),
        ),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'OFF'}, (0, 'OFF', ())),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': ''}, (0, 'SUBNET', ())),
        ({'ROS_AUTOMATIC_DISCOVERY_RANGE': 'subnet'}, (0, 'LOCALHOST', ())),
        ({'ROS_STATIC_PEERS': '10.0.0.2; robot;'}, (0, 'SUBNET', ('10.0.0.2', 'robot'))),
        ({'ROS_DISCOVERY_SERVER': ';robot:7'}, (0, 'SUBNET', (), ((1, 'robot', 7, 'UDPv4'),))),
    ],
)
def test_reach(environment: dict[str, str], expected: tuple[Any, ...]) -> None:
    """The variables of ROS say which domain and how far."""
    assert read_reach(environment) == Reach(*expected)


@pytest.mark.parametrize(
    ('environment', 'reason'),
    [
        ({'ROS_DOMAIN_ID': '-1'}, "ROS_DOMAIN_ID is '-1'.*0 to 232.*unset ROS_DOMAIN_ID"),
        ({'ROS_DOMAIN_ID': '233'}, "ROS_DOMAIN_ID is '233'"),
        ({'ROS_DISCOVERY_SERVER': '10.0.0.1:x'}, 'ROS_DISCOVERY_SERVER.*write HOST:PORT'),
    ],
)
def test_impossible_reach(environment: dict[str, str], reason: str) -> None:
    """What cannot be reached is a sentence with a way out."""
    with pytest.raises(RuntimeError, match=reason):
        read_reach(environment)


def row(port: int, inode: int) -> str:
    """Return a row of the kernel's table of UDP sockets."""
    return f' 1: 00000000:{port:04X} 00000000:0000 07 00000000:00000000 00:0 0 0 0 {inode} 2 0 0'


def test_participants_have_two_ports() -> None:
    """The pair of ports of a participant counts, not one alone, nor our own nor a foreign one."""
    rows = [row(port, 1) for port in (17910, 17911, 17912, 17916, 17917, 7410, 7411)]
    rows += [row(17914, 4), row(17915, 4)]
    assert list(ports_in_table(rows, {'4'}, domain_id=42)) == [17910, 17916]
    assert list(ports_in_table(rows, set(), domain_id=42)) == [17910, 17914, 17916]
    assert ports_in_table(rows, set(), domain_id=0) == {7410: '1'}
    assert ports_in_table([], set(), domain_id=42) == {}


def test_own_participant_is_not_counted(rclpy_node: Node, robot: dict[str, str]) -> None:
    """Of the robot and of this process only the robot is somebody else."""
    ports = participant_ports(int(robot['ROS_DOMAIN_ID']))
    assert ports is not None
    assert len(ports) == 1
