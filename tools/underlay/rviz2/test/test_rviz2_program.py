# SPDX-License-Identifier: Apache-2.0
"""Tests of rviz2 as a program."""

from collections.abc import Iterator
import os
from pathlib import Path
import re
import signal
import socket
import subprocess
import sys
import time
from typing import IO
import urllib.error
import urllib.request

from domain_coordinator import domain_id
import pytest

FILE = 'Visualization Manager:\n  Displays:\n    - Class: a/B\n      Name: Unknown\n'
PATIENCE_S = 100.0


class Program:
    """A running rviz2."""

    def __init__(self, log: IO[str], process: 'subprocess.Popen[str]') -> None:
        self._log = log
        self.process = process

    @property
    def said(self) -> str:
        """Return all that it has printed."""
        return Path(self._log.name).read_text()

    def url(self) -> str:
        """Wait until it serves, and return the address."""
        end_s = time.monotonic() + PATIENCE_S
        while True:
            found = re.search(r'RViz is at (http://\S+)', self.said)
            if found:
                return found[1]
            assert self.process.poll() is None and time.monotonic() < end_s, self.said
            time.sleep(0.05)

    def end(self, number: int) -> int:
        """Send a signal, and return the exit status."""
        self.process.send_signal(number)
        return self.process.wait(PATIENCE_S)


@pytest.fixture
def environment() -> Iterator[dict[str, str]]:
    """Return an environment with a domain of its own."""
    with domain_id() as domain:
        yield {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        }


@pytest.fixture
def start(environment: dict[str, str], tmp_path: Path) -> Iterator:
    """Return what starts rviz2."""
    running: list[Program] = []

    def start(*words: str) -> Program:
        with open(tmp_path / f'{len(running)}.log', 'w') as log:
            process = subprocess.Popen(
                [sys.executable, '-m', 'rviz2.rviz2', *words],
                stdout=log,
                stderr=subprocess.STDOUT,
                env=environment,
                text=True,
            )
        running.append(Program(log, process))
        return running[-1]

    yield start
    for program in running:
        if program.process.poll() is None:
            program.process.kill()
        program.process.wait()


def run(environment: dict[str, str], *words: str) -> 'subprocess.CompletedProcess[str]':
    """Run rviz2 to its end."""
    return subprocess.run(
        [sys.executable, '-m', 'rviz2.rviz2', *words],
        capture_output=True,
        env=environment,
        text=True,
        timeout=PATIENCE_S,
    )


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_it_serves_a_page_and_ends_well(start, tmp_path: Path, number: int) -> None:
    """The address that is logged has the page; a signal ends it with status 0."""
    path = tmp_path / 'a.rviz'
    path.write_text(FILE)
    program = start('-d', str(path), '-f', 'odom', '--ros-args', '-p', 'hots:=x')
    browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
    with browser.open(program.url()) as answer:
        assert answer.status == 200 and answer.url == program.url().partition('?')[0]
    end_s = time.monotonic() + PATIENCE_S
    while f"'Unknown' ({path}:3)" not in program.said:
        assert time.monotonic() < end_s, program.said
        time.sleep(0.05)
    while "There is no parameter 'hots'. Did you mean 'host'?" not in program.said:
        assert time.monotonic() < end_s, program.said
        time.sleep(0.05)
    assert program.end(number) == 0
    assert 'Traceback' not in program.said


def test_a_file_that_is_missing(start, tmp_path: Path) -> None:
    """It is said, with the whole path, and the page is there with the defaults."""
    path = tmp_path / 'config' / 'robot_view.rviz'
    program = start('-d', str(path))
    browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
    with browser.open(program.url()) as answer:
        assert answer.status == 200
    assert '[WARN]' in program.said
    assert f'{path}: File not found. Looked for {path}. RViz opens' in program.said
    assert program.end(signal.SIGINT) == 0


@pytest.mark.parametrize('host', ['127.0.0.1', '0.0.0.0'])
def test_needs_a_token(start, host: str) -> None:
    """The address has a token that was made up; without it nothing is shown."""
    url = start('--ros-args', '-p', f'host:={host}').url()
    address, token = url.split('?token=')
    assert len(token) > 10
    with pytest.raises(urllib.error.HTTPError, match='401'):
        urllib.request.urlopen(address)


def test_no_token_when_asked_for(start) -> None:
    """`token:=none` shows the page to whoever is on this machine."""
    url = start('--ros-args', '-p', 'token:=none').url()
    assert '?' not in url
    with urllib.request.urlopen(url) as answer:
        assert answer.status == 200


def test_a_port_in_use_is_named(environment: dict[str, str]) -> None:
    """The program does not choose another one than it was told."""
    with socket.socket() as used:
        used.bind(('127.0.0.1', 0))
        used.listen()
        port = used.getsockname()[1]
        ended = run(environment, '--ros-args', '-p', f'port:={port}')
    assert ended.returncode == 1
    assert f'Port {port} of 127.0.0.1 cannot be taken' in ended.stderr
    assert 'Traceback' not in ended.stderr


@pytest.mark.parametrize(
    ('words', 'status', 'sentence'),
    [
        (('-d', '.'), 1, 'The file cannot be read: Is a directory'),
        (('--display-conf', 'x'), 2, 'unrecognized arguments: --display-conf'),
        (('some.rviz',), 2, 'unrecognized arguments: some.rviz'),
        (('--ros-args', '-p', 'host:=nowhere'), 1, "The host is 'nowhere', but must be"),
        (('--ros-args', '-p', 'port:=70000'), 1, 'must be from 1 to 65535'),
        (('--ros-args', '-p', 'port:=x'), 1, "'port'"),
    ],
)
def test_what_cannot_be_is_refused(
    environment: dict[str, str], words: tuple[str, ...], status: int, sentence: str
) -> None:
    """One sentence says what is wrong, and nothing is served."""
    ended = run(environment, *words)
    assert ended.returncode == status
    assert sentence in ended.stderr
    assert 'Traceback' not in ended.stderr
    assert 'RViz is at' not in ended.stderr


def test_a_broken_file_is_named_with_the_line(environment: dict[str, str], tmp_path: Path) -> None:
    """Nothing starts."""
    path = tmp_path / 'b.rviz'
    path.write_text('Panels: ~\nPanels: ~\n')
    ended = run(environment, '--display-config', str(path))
    assert ended.returncode == 1
    assert ended.stderr.startswith(f"{path}:2: 'Panels' is already in line 1")
    assert len(ended.stderr.splitlines()) == 1


def test_help_says_the_parameters(environment: dict[str, str]) -> None:
    """The options are those of the genuine program; the parameters are of the page."""
    ended = run(environment, '--help')
    assert ended.returncode == 0
    for word in ('--display-config', '--fixed-frame', '--ogre-log', 'host:=', 'token:='):
        assert word in ended.stdout
