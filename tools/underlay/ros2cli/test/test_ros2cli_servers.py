# SPDX-License-Identifier: Apache-2.0
"""Tests of discovery servers: their addresses, whether they answer, and the graph they know."""

from collections.abc import Callable, Iterator
import os
import socket
import subprocess
import sys
import threading
import time
from typing import Any

import pytest
from ros2cli.graph.graph import Graph
from ros2cli.graph.probe import ask_server, ask_servers
from ros2cli.graph.servers import as_super_client, read_servers, Server, SERVERS, SUPER_CLIENT
from ros2cli.graph.watch import GraphWatch
from ros2cli.rtps.super_client import server_number, server_prefix

LOOPBACK = '127.0.0.1'
TIMEOUT_S = 60.0
CHILD = """
import rclpy, time
rclpy.init()
node = rclpy.create_node('child')
node.create_publisher(__import__('std_msgs.msg').msg.String, 'children', 10)
print('ready', flush=True)
time.sleep(600)
"""


def free_port() -> int:
    """Return a UDP port that is free."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as tried:
        tried.bind((LOOPBACK, 0))
        return int(tried.getsockname()[1])


@pytest.fixture(scope='module')
def server() -> Iterator[Server]:
    """Run a discovery server."""
    port = free_port()
    command = ['fast-discovery-server', '-i', '0', '-l', LOOPBACK, '-p', str(port)]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        found = Server(0, LOOPBACK, port)
        end_s = time.monotonic() + TIMEOUT_S
        while ask_server(found).error:
            assert process.poll() is None and time.monotonic() < end_s
            time.sleep(0.05)
        yield found
        process.kill()


@pytest.fixture
def client(server: Server, domain: int, monkeypatch: pytest.MonkeyPatch) -> str:
    """Have this process and its children use the server; return the variable."""
    monkeypatch.setenv(SERVERS, str(server))
    return str(server)


@pytest.fixture
def child(client: str) -> Iterator[subprocess.Popen[str]]:
    """Run a process with a node and a publisher, which knows nobody but the server."""
    with subprocess.Popen(
        [sys.executable, '-c', CHILD], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout
        assert process.stdout.readline() == 'ready\n'
        yield process
        process.kill()


def names(graph: Graph) -> list[str]:
    """Return the names of the nodes, sorted."""
    return sorted(name for name, _ in graph.get_node_names_and_namespaces())


def test_a_server_tells_of_all(child: subprocess.Popen[str], client: str) -> None:
    """Nodes, topics and their ends are known at once; one that is killed is gone at once."""
    with GraphWatch() as watch:
        graph = watch.settled_with(lambda graph: names(graph) == ['child'])
        assert names(graph) == ['child']
        assert dict(graph.get_topic_names_and_types())['/children'] == ['std_msgs/msg/String']
        [info] = graph.get_publishers_info_by_topic('/children')
        assert (info.node_name, info.qos_profile.depth) == ('child', 0)
        assert not graph.is_elsewhere(info)
        services = dict(graph.get_service_names_and_types())
        assert services['/child/get_parameters'] == ['rcl_interfaces/srv/GetParameters']
        child.kill()
        child.wait()
        assert watch.wait_for(lambda graph: not names(graph), None, TIMEOUT_S)


@pytest.mark.parametrize('verb', [('node', 'list'), ('topic', 'list')])
def test_verbs_ask_the_server(
    child: subprocess.Popen[str],
    client: str,
    ros2: Callable[..., Any],
    verb: tuple[str, str],
) -> None:
    """What `ros2` lists is what the server knows, also of nodes with which it shares nothing."""
    result = ros2(*verb, extra={SERVERS: client, 'ROS_DOMAIN_ID': os.environ['ROS_DOMAIN_ID']})
    expected = {'node': '/child', 'topic': '/children'}[verb[0]]
    assert expected in result.stdout.splitlines()
    assert (result.returncode, result.stderr) == (0, '')


def test_no_server_is_told(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """Without a server there is no node, and a sentence says why and what to do."""
    port = free_port()
    monkeypatch.setenv(SERVERS, f'{LOOPBACK}:{port}')
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    with GraphWatch(0.05) as watch:
        assert names(watch.settled()) == []
    told = capfd.readouterr().err
    assert told.startswith(f'WARNING: no discovery server answers at {LOOPBACK}:{port}')
    assert f'fastdds discovery -i 0 -p {port}' in told
    monkeypatch.setenv(SERVERS, '192.0.2.1')
    with GraphWatch(0.05) as watch:
        watch.settled()
    assert 'export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET' in capfd.readouterr().err


def test_a_server_is_asked(server: Server) -> None:
    """One that answers says which it is; where there is none, the reason is known."""
    assert ask_server(server) == (server, 0, '', False)
    second = server._replace(number=1, host='localhost')
    assert ask_server(second).number == 0
    closed = ask_server(Server(0, LOOPBACK, free_port()))
    assert (closed.number, closed.error) == (None, 'no program listens at this port there')
    unknown = ask_server(Server(0, 'robot.invalid', 11811))
    assert "'robot.invalid', which cannot be resolved" in unknown.error
    refused = ask_server(Server(0, LOOPBACK, free_port(), 'TCPv4'))
    assert refused.error == 'no program listens at this port there'


def test_servers_are_asked_at_the_same_time(
    server: Server, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A name that the resolver does not give up keeps nobody waiting."""
    never = threading.Event()

    def resolve(host: str) -> str:
        if host == 'slow':
            never.wait()
        return host

    monkeypatch.setattr(socket, 'gethostbyname', resolve)
    silent = Server(2, 'slow', 11811)
    try:
        answers = ask_servers([server, silent], patience_s=3.0)
    finally:
        never.set()
    assert answers == (
        (server, 0, '', False), (silent, None, 'its name could not be resolved within 3 s', True)
    )  # fmt: skip


@pytest.mark.parametrize('kind', ['UDPv4', 'TCPv4'])
@pytest.mark.parametrize('host', ['a..b', 'x' * 64, '.'])
def test_names_that_no_machine_can_have(host: str, kind: str) -> None:
    """They are a reason as any other."""
    assert ask_server(Server(0, host, 11811, kind)).error


def test_a_program_that_is_no_server() -> None:
    """Whoever is silent, or answers with anything else, is none."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind((LOOPBACK, 0))
        other.settimeout(TIMEOUT_S)
        port = other.getsockname()[1]
        echo = threading.Thread(target=lambda: other.sendto(*other.recvfrom(65536)))
        echo.start()
        assert (
            ask_server(Server(0, LOOPBACK, port), 0.2).error == 'there is no answer within 0.2 s'
        )
        echo.join()


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('', ()),
        ('10.0.0.1', [(0, '10.0.0.1', 11811, 'UDPv4')]),
        ('robot:7', [(0, 'robot', 7, 'UDPv4')]),
        (';;10.0.0.1:7; robot', [(2, '10.0.0.1', 7, 'UDPv4'), (3, 'robot', 11811, 'UDPv4')]),
        ('UDPv4:[10.0.0.1]:7', [(0, '10.0.0.1', 7, 'UDPv4')]),
        ('TCPv4:[10.0.0.1]:42100', [(0, '10.0.0.1', 42100, 'TCPv4')]),
        ('[::1]:7', [(0, '::1', 7, 'UDPv6')]),
    ],
)
def test_addresses(text: str, expected: list[tuple[Any, ...]]) -> None:
    """The position of an address is the ID of the server; the port has a default."""
    assert read_servers({SERVERS: text}) == tuple(expected)


@pytest.mark.parametrize('text', ['10.0.0.1:x', '10.0.0.1:7:8', 'a b', '10.0.0.1:70000', ':7'])
def test_what_is_no_address(text: str) -> None:
    """It is a sentence that shows how to write one."""
    with pytest.raises(RuntimeError, match=f"entry '{text}'.*write HOST:PORT"):
        read_servers({SERVERS: text})


@pytest.mark.parametrize('text', [' ', ';;', ' ; '])
def test_a_list_without_a_server(text: str) -> None:
    """Fast DDS then neither asks a server nor looks for others: it is a mistake."""
    with pytest.raises(RuntimeError, match=f"is '{text}', which names no server: unset"):
        read_servers({SERVERS: text})


def test_server_without_udp(monkeypatch: pytest.MonkeyPatch) -> None:
    """The commands say that they do not reach it, instead of an empty list."""
    monkeypatch.setenv(SERVERS, f'TCPv4:[{LOOPBACK}]:42100')
    with (
        pytest.raises(RuntimeError, match=r'42100.*TCPv4.*by UDP over IPv4 only'),
        GraphWatch() as w,
    ):
        w.settled()


def test_prefixes() -> None:
    """A server is known by its prefix, and nobody else is."""
    assert [server_number(server_prefix(number)) for number in (0, 7, 255)] == [0, 7, 255]
    assert server_number(b'DS\0_EPROSIMB') is None
    assert server_number(b'') is None


@pytest.mark.parametrize(
    ('before', 'within'),
    [
        ({}, {}),
        ({SERVERS: 'robot'}, {SERVERS: 'robot', SUPER_CLIENT: 'TRUE'}),
        ({SERVERS: 'robot', SUPER_CLIENT: 'FALSE'}, {SERVERS: 'robot', SUPER_CLIENT: 'FALSE'}),
    ],
)
def test_super_client(before: dict[str, str], within: dict[str, str]) -> None:
    """It is chosen only where there is a server, and the user's choice stays."""
    environment = dict(before)
    with as_super_client(environment):
        assert environment == within
    assert environment == before
