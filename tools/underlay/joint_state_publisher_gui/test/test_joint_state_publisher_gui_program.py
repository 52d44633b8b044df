# SPDX-License-Identifier: Apache-2.0
"""The program: where its page is, how it ends, and why it does not start."""

from __future__ import annotations

from pathlib import Path
import re
import signal
import socket
from urllib.error import HTTPError
from urllib.request import build_opener, HTTPCookieProcessor, Request, urlopen

from publisher_probe import Probe, Programs
import pytest
from sensor_msgs.msg import JointState

MODULE = 'joint_state_publisher_gui.program'
URDF = """<robot name="bot"> <link name="base"/> <link name="arm"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="arm"/></joint>
</robot>
"""


@pytest.fixture
def robot(tmp_path: Path) -> str:
    """Return the file of a robot."""
    file = tmp_path / 'bot.urdf'
    file.write_text(URDF)
    return str(file)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_serves_its_page_until_it_ends(
    probe: Probe, programs: Programs, robot: str, number: int
) -> None:
    """The address is logged; other sites are refused, and a signal ends it with status 0."""
    program = programs.start(MODULE, robot, num_rows='5', port='0')
    heard = probe.listen(JointState, '/joint_states')
    probe.until(lambda: heard, 'no joint states')
    probe.until(lambda: 'The sliders are at' in program.output, 'no address')
    (url,) = re.findall(r'The sliders are at (http://127.0.0.1:\d+/\?token=\S+)', program.output)
    with build_opener(HTTPCookieProcessor()).open(url, timeout=100) as response:
        assert b'<html' in response.read().lower()
    with pytest.raises(HTTPError, match='401'):
        urlopen(url.partition('?')[0], timeout=100)
    with pytest.raises(HTTPError, match='403'):
        urlopen(Request(url, headers={'Origin': 'http://evil.example'}), timeout=100)
    assert program.output.count("'num_rows' has no effect here") == 1
    assert 'There is no parameter' not in program.output
    assert program.end(number) == 0
    assert 'Traceback' not in program.output


def test_without_a_page(probe: Probe, programs: Programs, robot: str) -> None:
    """Where RViz has the sliders, the node publishes without a page of its own."""
    program = programs.start(MODULE, robot, own_page='false')
    heard = probe.listen(JointState, '/joint_states')
    probe.until(lambda: heard, 'no joint states')
    assert "The sliders are in the panel 'robot_console/Sliders' of RViz." in program.output
    assert program.end() == 0
    assert 'The sliders are at' not in program.output


def test_waits_for_a_robot(probe: Probe, programs: Programs) -> None:
    """Without a robot the page is there, and says what it waits for."""
    program = programs.start(MODULE, hots='1')
    probe.until(lambda: 'The sliders are at' in program.output, 'no address')
    assert "There is no parameter 'hots'. Did you mean 'host'?" in program.output
    assert 'Waiting for robot_description' in program.output
    assert program.end() == 0


@pytest.mark.parametrize(
    ('words', 'parameters', 'sentence'),
    [
        (['/no/arm.urdf'], {}, "The URDF '/no/arm.urdf' cannot be read: No such file"),
        (['a', 'b'], {}, 'joint_state_publisher_gui takes at most one URDF file'),
        ([], {'host': 'here'}, "The host is 'here', but must be an address of this machine"),
        ([], {'port': '8080.5'}, "The parameter 'port' must be a whole number, not 8080.5."),
        ([], {'port': '70000'}, 'The port is 70000, but must be from 1 to 65535.'),
        ([], {'port': 'web'}, "The parameter 'port' must be a number, not 'web'."),
        ([], {'own_page': '1'}, "The parameter 'own_page' must be true or false, not 1."),
        ([], {'token': '7'}, "The parameter 'token' must be a string, not 7."),
    ],
)
def test_cannot_start(programs: Programs, words, parameters, sentence) -> None:
    """What is wrong at the start is a sentence and status 1."""
    program = programs.start(MODULE, *words, **parameters)
    assert program.process.wait(100) == 1
    assert sentence in program.output
    assert 'Traceback' not in program.output


def test_ports_that_are_taken(programs: Programs) -> None:
    """A port that is given is not replaced by another one."""
    with socket.create_server(('127.0.0.1', 0)) as server:
        program = programs.start(MODULE, port=str(server.getsockname()[1]))
        assert program.process.wait(100) == 1
    assert 'cannot be taken: Address already in use.' in program.output
