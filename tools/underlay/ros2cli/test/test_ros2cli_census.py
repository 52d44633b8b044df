# SPDX-License-Identifier: Apache-2.0
"""Tests of who is waited for on this machine, and of the socket under attack."""

import io
from pathlib import Path
import socket
import subprocess
import sys
from typing import TextIO

import pytest
from ros2cli.graph import census as module
from ros2cli.graph.census import (
    AGAIN_S,
    Census,
    find_holders,
    Holder,
    participant_sockets,
    SILENCE_S,
)
from ros2cli.graph.link import MAX_WAITING, NeighbourLink
from ros2cli.graph.reach import LOCALHOST, Reach, read_interfaces, SUBNET
from ros2cli.graph.watch import GraphWatch
from ros2cli.rtps.identifiers import unicast_ports
from ros2cli.rtps.parameters import THIS_HOST

FIRST, SECOND = (THIS_HOST, 7410), (THIS_HOST, 7412)
BOTH = {FIRST: '1', SECOND: '2'}
HOLD = """
import socket, sys, time
held = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in sys.argv[1:]]
for each, port in zip(held, sys.argv[1:]):
    each.bind(('', int(port)))
print('ready', flush=True)
time.sleep(60)
"""


class Flood:
    """A socket at which there is always something more."""

    reads = 0

    def recvfrom(self, size: int) -> tuple[bytes, tuple[str, int]]:
        """Return what is not of RTPS."""
        self.reads += 1
        return b'noise', (THIS_HOST, 9)


def process(proc: Path, pid: int, *, thread: str, state: str = 'S', environ: str = '') -> None:
    """Write what the kernel tells of a process that holds the socket 5."""
    for folder in (f'{pid}/fd', f'{pid}/task/1', f'{pid}/task/2'):
        (proc / folder).mkdir(parents=True)
    (proc / f'{pid}/fd/3').symlink_to('socket:[5]')
    (proc / f'{pid}/task/1/comm').write_text('python3\n')
    (proc / f'{pid}/task/2/comm').write_text(f'{thread}\n')
    (proc / f'{pid}/stat').write_text(f'{pid} (a) b) {state} 1 2 3')
    (proc / f'{pid}/environ').write_text(f'HOME=/root\0{environ}\0')


@pytest.mark.parametrize(
    ('thread', 'state', 'environ', 'expected'),
    [
        ('dds.udp.7410', 'S', '', (7, True, False)),
        ('dds.udp.7410', 'T', '', (7, True, True)),
        ('dds.udp.7410', 'S', 'ROS_AUTOMATIC_DISCOVERY_RANGE=OFF', (7, False, False)),
        ('dds.udp.7410', 'S', 'ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET', (7, True, False)),
        ('worker', 'R', '', (7, False, False)),
    ],
)
def test_holders(tmp_path: Path, thread: str, state: str, environ: str, expected: Holder) -> None:
    """The threads, the state and the environment of a process tell whether it will answer."""
    process(tmp_path, 7, thread=thread, state=state, environ=environ)
    assert find_holders({'5', '6'}, str(tmp_path)) == {'5': expected}
    assert find_holders({'6'}, str(tmp_path)) == {}


def test_children_inherit_sockets(tmp_path: Path) -> None:
    """Of a participant and its child the participant counts, in whatever order they are found."""
    process(tmp_path, 7, thread='worker')
    process(tmp_path, 8, thread='dds.udp.7410')
    process(tmp_path, 9, thread='worker')
    assert find_holders({'5'}, str(tmp_path)) == {'5': Holder(8, True, False)}


@pytest.fixture
def holders(monkeypatch: pytest.MonkeyPatch) -> dict[str, Holder]:
    """Let a machine have two pairs of ports, and return who holds them."""
    found: dict[str, Holder] = {}
    monkeypatch.setattr(module, 'participant_sockets', lambda _: {7410: '1', 7412: '2'})
    monkeypatch.setattr(module, 'find_holders', lambda _: found)
    return found


def test_strangers_are_not_waited_for(holders: dict[str, Holder]) -> None:
    """A silent pair of ports of another program counts only until it is looked at."""
    holders['2'] = Holder(9, False, False)
    census = Census(0)
    assert census.take(0.0, []) == BOTH
    assert census.take(SILENCE_S / 2, [SECOND]) == BOTH
    assert census.take(SILENCE_S, [SECOND]) == {FIRST: '1'}
    assert census.take(2 * SILENCE_S, []) == {FIRST: '1'}
    assert not census.are_stopped([])
    holders['2'] = Holder(9, True, False)
    assert census.take(SILENCE_S + AGAIN_S, []) == BOTH


def test_stopped_processes(holders: dict[str, Holder]) -> None:
    """Only if all who are silent are stopped is it no use to wait."""
    holders['2'] = Holder(9, True, True)
    census = Census(0)
    census.take(0.0, [])
    assert census.take(SILENCE_S, [FIRST, SECOND]) == BOTH
    assert not census.are_stopped([FIRST, SECOND])
    assert census.are_stopped([SECOND])


def test_ports_of_another_program(domain: int, capfd: pytest.CaptureFixture[str]) -> None:
    """A program that has the ports of a participant by chance is neither listed nor missed."""
    port = unicast_ports(domain)[0]
    command = [sys.executable, '-c', HOLD, str(port), str(port + 1)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        assert process.stdout.readline() == 'ready\n'
        with GraphWatch() as watch:
            assert watch.settled().get_node_names_and_namespaces() == []
        process.kill()
    assert capfd.readouterr().err == ''


def test_flood_is_no_endless_loop(monkeypatch: pytest.MonkeyPatch) -> None:
    """However much arrives, an exchange ends, and what waits is bounded."""
    link = NeighbourLink(Reach(0, LOCALHOST))
    link.close()
    flood = Flood()
    monkeypatch.setattr(link, '_socket', flood)
    for _ in range(3):
        link._receive()
        assert 0 < len(link._waiting) <= MAX_WAITING
    assert flood.reads > MAX_WAITING


def test_interface_that_goes(monkeypatch: pytest.MonkeyPatch) -> None:
    """An interface that is gone between two questions to the kernel is none."""
    monkeypatch.setattr(socket, 'if_nameindex', lambda: [(1, 'gone0'), (2, 'lo')])
    assert [each.name for each in read_interfaces()] == ['lo']


def test_peer_without_address(monkeypatch: pytest.MonkeyPatch) -> None:
    """A peer whose name is unknown is a sentence with a way out, as no node could start."""

    def fail(_: str) -> str:
        raise socket.gaierror(-2, 'Name or service not known')

    monkeypatch.setattr(socket, 'gethostbyname', fail)
    with pytest.raises(RuntimeError, match="ROS_STATIC_PEERS names 'robot'.*unset"):
        NeighbourLink(Reach(0, SUBNET, ('robot',)))


@pytest.mark.parametrize(('count', 'reads'), [(5, 1), (100, 3)])
def test_sockets_that_are_skipped_while_others_close(
    monkeypatch: pytest.MonkeyPatch, count: int, reads: int
) -> None:
    """A table of several pages is read again, since the kernel may skip other rows each time."""
    ports = range(7410, 7410 + count)
    rows = [
        f' {port}: 0100007F:{port:04X} 00000000:0000 07 0:0 00:0 0 0 0 {port}' for port in ports
    ]
    read: list[str] = []

    def open_table(path: str, encoding: str) -> TextIO:
        read.append(path)
        skipped = len(read) if count > 5 else count
        return io.StringIO('\n'.join(['header', *rows[:skipped], *rows[skipped + 1 :]]) + '\n')

    monkeypatch.setattr(module, 'open', open_table, raising=False)
    found = participant_sockets(0)
    assert read == ['/proc/net/udp'] * reads
    assert found == {port: str(port) for port in unicast_ports(0) if port + 1 in ports}
