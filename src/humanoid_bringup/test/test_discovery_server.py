# SPDX-License-Identifier: Apache-2.0
"""Check that the discovery server starts, says what to type, and ends."""

from __future__ import annotations

from pathlib import Path
import re
import shutil
import signal
import socket

from humanoid_bringup import discovery_server
from humanoid_bringup.discovery_server import (
    check_port,
    instructions,
    own_addresses,
    ServerSettings,
)
from humanoid_common.testing.launching import running_launch_file
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'discovery_server.launch.py'
LOOPBACK = '127.0.0.1'
TIMEOUT_S = 60.0


@pytest.fixture
def port() -> int:
    """Return a UDP port that is free."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as tried:
        tried.bind((LOOPBACK, 0))
        return int(tried.getsockname()[1])


@pytest.mark.skipif(not shutil.which('fast-discovery-server'), reason='no Fast DDS is installed')
def test_server_says_what_to_type_and_ends(port: int) -> None:
    """It runs at the address that is printed, as its port is taken, and ends with the launch."""
    arguments = (f'address:={LOOPBACK}', f'port:={port}', 'server_id:=2')
    with running_launch_file(LAUNCH_FILE, *arguments) as program:
        program.wait_for_output(
            f"    export ROS_DISCOVERY_SERVER=';;{LOOPBACK}:{port}'", TIMEOUT_S
        )
        with pytest.raises(ValueError, match=f'UDP port {port} is taken.*port:={port + 1}'):
            check_port(LOOPBACK, port)
        report = program.stop(signal.SIGINT, TIMEOUT_S)
    assert report.status == 0
    assert 'Traceback' not in report.output
    assert 'process has finished cleanly' in report.output
    check_port(LOOPBACK, port)


def test_what_to_type() -> None:
    """Other machines need the network, and the address of this one."""
    shared = instructions(ServerSettings('', 11811, 0), ['192.0.2.7'])
    assert 'export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET\n' in shared
    assert shared.endswith('    export ROS_DISCOVERY_SERVER=192.0.2.7:11811')
    for settings, own in ((('', 11811, 0), []), ((LOOPBACK, 11811, 0), ['192.0.2.7'])):
        alone = instructions(ServerSettings(*settings), own)
        assert 'on this machine only' in alone and 'SUBNET' not in alone
        assert alone.endswith(f'    export ROS_DISCOVERY_SERVER={LOOPBACK}:11811')
    two = instructions(ServerSettings('', 11811, 0), ['192.0.2.7', '198.51.100.7'])
    assert two.endswith('Machines in another network of this one use 198.51.100.7 instead.')


def test_each_address_of_this_machine() -> None:
    """An address that means each one is shown to nobody: no other machine could use it."""
    settings = ServerSettings.parse('0.0.0.0', '11811', '0')
    assert settings == ServerSettings.parse('', '11811', '0')
    assert '0.0.0.0' not in instructions(settings, own_addresses())


def test_addresses_without_a_default_route(monkeypatch: pytest.MonkeyPatch) -> None:
    """As on a robot with a network of its own, the addresses of the interfaces are known."""
    known = own_addresses()
    monkeypatch.setattr(discovery_server, '_address_of_route', lambda: '')
    assert set(own_addresses()) == set(known)
    assert discovery_server._address_of('lo') == LOOPBACK
    assert discovery_server._address_of('no_such_one') == ''


@pytest.mark.parametrize(
    ('texts', 'reason'),
    [
        (('robot', '11811', '0'), "'address' is 'robot', but must be an IPv4 address"),
        (('224.0.0.1', '11811', '0'), "'address' is '224.0.0.1', but must be an IPv4 address of"),
        (('255.255.255.255', '11811', '0'), "'address' is '255.255.255.255'"),
        (('', '80', '0'), "'port' is '80', but must be a whole number from 1025 to 65535"),
        (('', '11811', '256'), "'server_id' is '256', but must be .* from 0 to 255"),
        (('', '1e4', '0'), "'port' is '1e4'"),
        (('', '-1', '0'), "'port' is '-1'.*Pass for example 'port:=11811'"),
        (('', '99999', '0'), "'port' is '99999'"),
        (('', '9' * 5000, '0'), "'port' is '9{80}...'"),
        (('', '', '0'), "'port' is ''"),
    ],
)
def test_impossible_settings(texts: tuple[str, str, str], reason: str) -> None:
    """What cannot be is said before anything starts."""
    with pytest.raises(ValueError, match=reason):
        ServerSettings.parse(*texts)


def test_an_address_of_another_machine() -> None:
    """The server itself would start there, and hear nobody."""
    with pytest.raises(ValueError, match=re.escape('192.0.2.99 is not an address of this')):
        check_port('192.0.2.99', 11811)
