# SPDX-License-Identifier: Apache-2.0
"""Drive with the keys of a terminal, and get the terminal back."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
import fcntl
import math
import os
import pty
import signal
import subprocess
import termios
from typing import Any

from geometry_msgs.msg import Twist
from publisher_probe import Probe
import pytest
from rclpy.action import ActionServer, CancelResponse
from turtlesim.action import RotateAbsolute
from turtlesim_py.teleop import HEADINGS, keys_of


@pytest.mark.parametrize(
    ('text', 'keys', 'rest'),
    [
        ('', [], ''),
        ('gQ', ['g', 'q'], ''),
        ('\x1b[A\x1bODx', ['\x1b[A', '\x1b[D', 'x'], ''),
        ('\x1bOQ\x1b[1;5Cq', ['\x1b[Q', '\x1b[1;5C', 'q'], ''),
        ('\x1b[24~', ['\x1b[24~'], ''),
        ('\x1bg', ['\x1b', 'g'], ''),
        ('g\x1b', ['g'], '\x1b'),
        ('g\x1b[1;', ['g'], '\x1b[1;'),
        ('\x1bO', [], '\x1bO'),
    ],
)
def test_keys_of_a_terminal(text: str, keys: list[str], rest: str) -> None:
    """An escape sequence is one key, in both modes of a terminal; letters may be capital."""
    assert keys_of(text) == (keys, rest)


def test_headings_are_where_keys_are() -> None:
    """The keys around F turn a turtle into their direction."""
    degrees = {key: round(math.degrees(angle)) for key, angle in HEADINGS.items()}
    expected = {'g': 0, 't': 45, 'r': 90, 'e': 135, 'd': 180, 'c': -135, 'v': -90, 'b': -45}
    assert degrees == expected


class Terminal:
    """A terminal in which a program runs."""

    def __init__(self, domain: int) -> None:
        """Start turtle_teleop_key."""
        self._ours, self._theirs = pty.openpty()
        self.before = self.modes()
        self.shown = ''
        os.set_blocking(self._ours, False)
        command = ['ros2', 'run', 'turtlesim', 'turtle_teleop_key']
        self.process = subprocess.Popen(
            [*command, '--ros-args', '-p', 'scale_linear:=0.5', '-p', 'scale_anguler:=1.0'],
            stdin=self._theirs,
            stdout=self._theirs,
            stderr=self._theirs,
            preexec_fn=self._take,
        )

    def _take(self) -> None:
        """Make the terminal that of a session of its own, so that Ctrl-C becomes a signal."""
        os.setsid()
        fcntl.ioctl(self._theirs, termios.TIOCSCTTY, 0)

    def modes(self) -> Any:
        """Return how the terminal is set."""
        return termios.tcgetattr(self._theirs)[:4]

    def type(self, keys: str) -> None:
        """Press keys."""
        os.write(self._ours, keys.encode())

    def has_shown(self, text: str) -> bool:
        """Tell whether the program has written a text."""
        with suppress(BlockingIOError):
            self.shown += os.read(self._ours, 10000).decode()
        return text in self.shown

    def close(self) -> None:
        """End the program, if it runs."""
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        for end in (self._ours, self._theirs):
            os.close(end)


@pytest.fixture
def terminal(domain: int) -> Iterator[Terminal]:
    """Run the program in a terminal."""
    made = Terminal(domain)
    yield made
    made.close()


def test_drive(probe: Probe, terminal: Terminal) -> None:
    """Arrows are commands, letters goals, F cancels; Q ends it, and the terminal is as before."""
    goals: list[float] = []
    canceled: list[float] = []

    def cancel(handle: Any) -> CancelResponse:
        canceled.append(handle.request.theta)
        return CancelResponse.ACCEPT

    commands = probe.listen(Twist, '/turtle1/cmd_vel')
    probe.until(lambda: terminal.has_shown("'Q' to quit."), 'it does not begin')
    terminal.type('g')
    probe.until(lambda: terminal.has_shown('No node offers the action'), 'it says nothing')
    assert "There is no parameter 'scale_anguler'. Did you mean 'scale_angular'?" in terminal.shown
    server = ActionServer(
        probe.node,
        RotateAbsolute,
        'turtle1/rotate_absolute',
        lambda handle: RotateAbsolute.Result(),
        handle_accepted_callback=lambda handle: goals.append(handle.request.theta),
        cancel_callback=cancel,
    )
    for key, command in (('\x1b[A', (0.5, 0.0)), ('\x1b[D', (0.0, 2.0))):
        commands.clear()
        probe.send_until(lambda key=key: terminal.type(key), lambda: commands, 'no command')
        assert (commands[-1].linear.x, commands[-1].angular.z) == command
    probe.send_until(lambda: terminal.type('E'), lambda: goals, 'no goal')
    terminal.type('f')
    probe.until(lambda: canceled, 'no goal was canceled')
    assert canceled == [pytest.approx(math.radians(135))]
    terminal.type('q')
    probe.until(lambda: terminal.process.poll() is not None, 'it does not end')
    assert terminal.process.returncode == 0
    assert terminal.modes() == terminal.before
    server.destroy()


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_signals(probe: Probe, terminal: Terminal, number: int) -> None:
    """Ctrl-C and SIGTERM end it with status 0, and give the terminal back."""
    probe.until(lambda: terminal.has_shown("'Q' to quit."), 'it does not begin')
    assert terminal.modes() != terminal.before
    if number == signal.SIGINT:
        terminal.type('\x03')
    else:
        terminal.process.terminate()
    probe.until(lambda: terminal.process.poll() is not None, 'it does not end')
    assert terminal.process.returncode == 0
    assert terminal.modes() == terminal.before
    assert not terminal.has_shown('Traceback')


def test_without_a_terminal(domain: int) -> None:
    """Where there is no terminal, it says so, and ends with status 1."""
    done = subprocess.run(
        ['ros2', 'run', 'turtlesim', 'turtle_teleop_key'],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert done.returncode == 1
    assert 'reads the keys of a terminal' in done.stderr
