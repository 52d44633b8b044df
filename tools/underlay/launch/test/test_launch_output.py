# SPDX-License-Identifier: Apache-2.0
"""Much output, slow readers, and many processes one after the other."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
import os
from pathlib import Path
import signal
import subprocess
import threading
import time
from types import SimpleNamespace
from typing import Any

from launch._supervision.process_output import LineFormat
from launch._supervision.running_process import OutputStream
from launch.actions import ExecuteProcess
from launch.logging._screen import Backlog
import pytest

FLOOD = """
import os
from launch import LaunchDescription
from launch.actions import ExecuteProcess, OpaqueFunction, TimerAction
def generate_launch_description():
    return LaunchDescription([
        ExecuteProcess(cmd=['yes', 'much'], output='screen'),
        TimerAction(period=1.0, actions=[
            OpaqueFunction(function=lambda _: open({path!r}, 'w').close())]),
    ])
"""


@pytest.fixture
def pipe() -> Iterator[tuple[int, int]]:
    """Return the ends of a pipe that nobody reads unless the test does."""
    ends = os.pipe()
    yield ends
    for end in ends:
        os.close(end)


@pytest.mark.parametrize(
    'text, expected',
    [
        ('[{this.name}] {line}', '[n] a\n[n] b'),
        ('{line}', 'a\nb'),
        ('<{line}>', '<a>\n<b>'),
        ('{line!r}{line}', "'a'a\n'b'b"),
        ('{{{line}}}', '{a}\n{b}'),
        ('nothing', 'nothing\nnothing'),
    ],
)
def test_line_format(text: str, expected: str) -> None:
    """Each line gets the format, however often the line stands in it."""
    assert LineFormat(text, SimpleNamespace(name='n')).apply(['a', 'b']) == expected


def test_backlog_of_a_ready_reader(pipe: tuple[int, int]) -> None:
    """What the reader can take is written at once, in the calling thread."""
    threads = threading.active_count()
    backlog = Backlog(pipe[1], pytest.fail)
    backlog.write(b'at once')
    assert os.read(pipe[0], 100) == b'at once'
    assert backlog.is_empty and threading.active_count() == threads


def test_backlog_of_a_slow_reader(pipe: tuple[int, int], wait_until: Any) -> None:
    """What the reader cannot take waits, in order; who asks learns when there is room again."""
    backlog = Backlog(pipe[1], pytest.fail)
    sent = [b'%06d\n' % number for number in range(100_000)]
    for line in sent:
        backlog.write(line)
    room = threading.Event()
    backlog.when_clear(room.set)
    assert backlog.is_congested and not room.is_set()
    received = b''
    while len(received) < 700_000:
        received += os.read(pipe[0], 65536)
    assert received == b''.join(sent)
    wait_until(lambda: backlog.is_empty and room.is_set())
    assert not backlog.is_congested


def test_backlog_takes_much_at_once(tmp_path: Path) -> None:
    """The time to write a large piece grows with its size, not with the square of it."""
    path = tmp_path / 'screen'
    data = b'x' * 100_000_000
    with path.open('wb') as file:
        backlog = Backlog(file.fileno(), pytest.fail)
        began = time.process_time()
        backlog.write(data)
        assert time.process_time() - began < 30.0
    assert backlog.is_empty and path.stat().st_size == len(data)


def test_backlog_without_a_reader() -> None:
    """When nobody will ever read, that is told once, and nothing waits for ever."""
    reading_end, writing_end = os.pipe()
    os.close(reading_end)
    errors: list[OSError] = []
    backlog = Backlog(writing_end, errors.append)
    backlog.write(b'x' * 10_000)
    os.close(writing_end)
    assert [type(error) for error in errors] == [BrokenPipeError] and backlog.is_empty


def test_stream_waits_for_the_screen(
    monkeypatch: pytest.MonkeyPatch, pipe: tuple[int, int]
) -> None:
    """Nothing is read from a process while the screen is congested, and all of it later."""
    waiting: list[Callable[[], None]] = []
    screen = SimpleNamespace(is_congested=True, when_clear=waiting.append)
    monkeypatch.setattr('launch._supervision.running_process.screen', screen)
    read: list[bytes] = []

    async def follow() -> None:
        stream = OutputStream(asyncio.get_running_loop(), os.dup(pipe[0]), read.append)
        os.write(pipe[1], b'text')
        while not waiting:
            await asyncio.sleep(0)
        assert read == []
        screen.is_congested = False
        waiting[0]()
        while not read:
            await asyncio.sleep(0)
        stream.close()

    asyncio.run(asyncio.wait_for(follow(), 10))
    assert read == [b'text']


def test_reader_that_does_not_read(
    launch_command: list[str], write: Any, tmp_path: Path, wait_until: Any
) -> None:
    """A launch whose output nobody reads goes on, needs no memory for it, and can be ended."""
    sign = tmp_path / 'sign'
    command = [*launch_command, write('flood.launch.py', FLOOD.format(path=str(sign)))]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as launch:
        try:
            wait_until(sign.exists, 30, 'the timer of a launch that cannot write')
            assert _resident_mib(launch.pid) < 100
        finally:
            launch.send_signal(signal.SIGINT)
            text = launch.communicate(timeout=100)[0]
    assert launch.returncode == 0
    others = [line for line in text.decode().splitlines() if line != '[yes-1] much']
    cut = [line.removeprefix('[yes-1] ') for line in others if line.startswith('[yes-1] ')]
    assert len(cut) < 2 and all('much'.startswith(text) for text in cut)
    assert 'process has died' in others[-1]


def _resident_mib(pid: int) -> int:
    status = Path(f'/proc/{pid}/status').read_text()
    return int(status.partition('VmRSS:')[2].split()[0]) // 1024


@pytest.mark.usefixtures('no_child_is_left')
def test_thousand_respawns(run: Any) -> None:
    """A process that starts again a thousand times leaves no descriptor, thread or child."""
    run(ExecuteProcess(cmd=['/bin/true']))
    before = len(os.listdir('/proc/self/fd'))
    threads = threading.active_count()
    action = ExecuteProcess(cmd=['/bin/true'], respawn=True, respawn_max_retries=999)
    result = run(action)
    assert result.text.count('process started with pid') == 1000
    assert result.text.count('process has finished cleanly') == 1000
    assert len(os.listdir('/proc/self/fd')) <= before
    assert threading.active_count() == threads
