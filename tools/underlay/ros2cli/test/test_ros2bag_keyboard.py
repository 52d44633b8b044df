# SPDX-License-Identifier: Apache-2.0
"""Tests of the keys that control a player in a terminal."""

from collections.abc import Callable, Iterator
import os
from pathlib import Path
import pty
import termios
from typing import Any

from bag_samples import write_bag
import pytest
from ros2bag.api.control import Keyboard

Start = Callable[..., Any]


@pytest.fixture
def terminal() -> Iterator[tuple[int, int]]:
    """Return both ends of a terminal."""
    ends = pty.openpty()
    yield ends
    for end in ends:
        os.close(end)


def _expect(process: Any, text: str) -> None:
    for line in process.stderr:
        if text in line:
            return
    pytest.fail(f'no line with {text!r}')


def test_keys_pause_step_and_change_the_rate(
    terminal: tuple[int, int], start_ros2: Start, tmp_path: Path
) -> None:
    """SPACE pauses and resumes, UP changes the rate; the terminal is as before afterwards."""
    write_bag(tmp_path / 'bag', count=2000)
    ours, theirs = terminal
    before = termios.tcgetattr(theirs)
    words = ['bag', 'play', str(tmp_path / 'bag'), '--start-paused']
    process = start_ros2(*words, stdin=theirs, preexec_fn=lambda: _own_terminal(theirs))
    _expect(process, 'Paused: press SPACE or call the service')
    assert not termios.tcgetattr(theirs)[3] & termios.ECHO
    for key, line in ((b' ', 'Resumed.'), (b'\x1b[A', 'Rate: 1.1'), (b' ', 'Paused.')):
        os.write(ours, key)
        _expect(process, line)
    os.write(ours, b'\x03')
    assert process.wait(timeout=100) == 2
    assert termios.tcgetattr(theirs)[3] == before[3]


def test_no_keys_without_a_terminal() -> None:
    """Where stdin is no terminal, nothing is changed and nothing pressed."""
    with Keyboard(enabled=True) as keyboard:
        assert not keyboard.is_reading
        assert keyboard.pressed() == ''


def _own_terminal(descriptor: int) -> None:
    """Make the terminal that of a session of its own, so that Ctrl-C becomes a signal."""
    import fcntl

    os.setsid()
    fcntl.ioctl(descriptor, termios.TIOCSCTTY, 0)
