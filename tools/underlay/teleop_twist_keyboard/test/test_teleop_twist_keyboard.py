# SPDX-License-Identifier: Apache-2.0
"""Drive with the keys of a terminal."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
import fcntl
import os
import pty
import signal
import subprocess
import termios
from typing import Any

from geometry_msgs.msg import TwistStamped
import pytest
from teleop_twist_keyboard.driving import Driving, Velocity

READY = 'currently:\tspeed 0.2\tturn 1'


@pytest.mark.parametrize(
    ('key', 'velocity'),
    [
        ('i', Velocity(x=0.5)),
        ('u', Velocity(x=0.5, yaw=1.0)),
        ('m', Velocity(x=-0.5, yaw=-1.0)),
        ('J', Velocity(y=0.5)),
        ('>', Velocity(x=-0.5, y=-0.5)),
        ('b', Velocity(z=-0.5)),
        ('k', Velocity()),
        ('\x1b[A', Velocity()),
    ],
)
def test_directions(key: str, velocity: Velocity) -> None:
    """Keys are directions; one without a meaning stops."""
    driving = Driving()
    driving.press('i')
    assert driving.press(key) == ''
    assert driving.velocity == velocity


def test_speeds() -> None:
    """Speeds change by a tenth, and the direction stays."""
    driving = Driving()
    driving.press('u')
    for key in 'qwx':
        driving.press(key)
    assert driving.press('c') == 'currently:\tspeed 0.5445\tturn 0.99'
    assert driving.velocity == pytest.approx((0.5445, 0.0, 0.0, 0.99))


def in_domain(domain: int) -> dict[str, str]:
    """Return the environment of a program in a domain."""
    return {
        **os.environ,
        'ROS_DOMAIN_ID': str(domain),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
    }


class Terminal:
    """A terminal in which the program runs."""

    def __init__(self, domain: int) -> None:
        """Start it."""
        self._ours, self._theirs = pty.openpty()
        self.before = self.modes()
        self.shown = ''
        os.set_blocking(self._ours, False)
        program = 'teleop_twist_keyboard'
        parameters = ('speed:=0.2', 'stamped:=true', 'frame_id:=base_link')
        self.process = subprocess.Popen(
            ['ros2', 'run', program, program, '--ros-args']
            + [word for parameter in parameters for word in ('-p', parameter)],
            stdin=self._theirs,
            stdout=self._theirs,
            stderr=self._theirs,
            env=in_domain(domain),
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


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_drive_and_quit(probe: Any, terminal: Terminal, number: int) -> None:
    """Each key publishes; Ctrl-C and SIGTERM stop the robot, with the terminal as before."""
    commands = probe.listen(TwistStamped, '/cmd_vel')
    probe.until(lambda: terminal.has_shown(READY), 'it does not begin')
    probe.send_until(lambda: terminal.type('i'), lambda: commands, 'no command')
    assert commands[-1].twist.linear.x == 0.2
    assert commands[-1].header.frame_id == 'base_link'
    assert commands[-1].header.stamp.sec > 0
    if number == signal.SIGINT:
        terminal.type('\x03')
    else:
        terminal.process.terminate()
    probe.until(lambda: terminal.process.poll() is not None, 'it does not end')
    assert terminal.process.returncode == 0
    probe.until(lambda: commands[-1].twist.linear.x == 0.0, 'it does not stop the robot')
    assert terminal.modes() == terminal.before


def test_without_a_terminal(domain: int) -> None:
    """Without a terminal it says where it has to be started."""
    program = 'teleop_twist_keyboard'
    done = subprocess.run(
        ['ros2', 'run', program, program],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        env=in_domain(domain),
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert 'reads the keys of a terminal' in done.stderr
