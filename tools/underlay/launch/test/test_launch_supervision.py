# SPDX-License-Identifier: Apache-2.0
"""The parts that watch over processes."""

from __future__ import annotations

import asyncio
import io
import os
import signal
import subprocess

from launch._supervision.family import Family
from launch._supervision.orphan_guard import OrphanGuard
from launch._supervision.process_group import end_leftovers, is_empty, living_members, send_signal
from launch._supervision.process_output import LineSplitter
from launch._supervision.running_process import watch_exit
import pytest


def test_line_splitter() -> None:
    """Lines are returned when they are complete; a character may be cut in two."""
    splitter = LineSplitter()
    assert splitter.feed(b'a') == []
    assert splitter.feed(b'b\n\nc\xc3') == ['ab', '']
    assert splitter.feed(b'\xa9\r\nd') == ['c\u00e9']
    assert (splitter.flush(), splitter.flush()) == (['d'], [])


def test_line_without_end() -> None:
    """A line that goes on and on is cut between two characters, and never held as a whole."""
    splitter = LineSplitter()
    text = 'x\u00e9\u20ac\U0001f916' * 300_000
    data = io.BytesIO(text.encode())
    chunks = iter(lambda: data.read(65_521), b'')
    pieces = [line for chunk in chunks for line in splitter.feed(chunk)]
    assert 2 <= len(pieces) <= 3 and all(len(piece) > 300_000 for piece in pieces)
    assert ''.join([*pieces, *splitter.flush()]) == text


def test_endless_binary_output() -> None:
    """Bytes that are no characters are cut as well."""
    splitter = LineSplitter()
    assert splitter.feed(b'\x80' * 2_000_000) == ['\ufffd' * 2_000_000]


@pytest.mark.parametrize('with_descriptor', [True, False])
def test_exit_watch(monkeypatch: pytest.MonkeyPatch, with_descriptor: bool) -> None:
    """The end of a child is noticed, also where the system has no descriptors for processes."""
    if not with_descriptor:

        def unsupported(pid: int) -> int:
            raise OSError('not supported')

        monkeypatch.setattr(os, 'pidfd_open', unsupported)

    async def watch() -> int:
        child = subprocess.Popen(['sh', '-c', 'exit 7'])
        return await asyncio.wait_for(watch_exit(child, asyncio.get_running_loop()), 10)

    assert asyncio.run(watch()) == 7


def _group_leader(script: str) -> subprocess.Popen[bytes]:
    child = subprocess.Popen(
        ['sh', '-c', f'{script}\necho ready\nwait'], stdout=subprocess.PIPE, start_new_session=True
    )
    assert child.stdout is not None
    child.stdout.readline()
    child.stdout.close()
    return child


def test_process_group() -> None:
    """A group is empty when all its members are dead."""
    leader = _group_leader('sleep 60 &')
    try:
        assert len(living_members(leader.pid)) == 2 and not is_empty(leader.pid)
        os.kill(leader.pid, signal.SIGKILL)
        leader.wait()
        assert len(living_members(leader.pid)) == 1 and not is_empty(leader.pid)
        asyncio.run(end_leftovers(leader.pid, was_interrupted=False))
        assert is_empty(leader.pid)
    finally:
        send_signal(leader.pid, signal.SIGKILL)
        leader.wait()


def test_signals_that_do_not_end_go_to_the_leader_alone() -> None:
    """A signal such as SIGUSR1 does not surprise what the process has started."""
    leader = _group_leader('sleep 60 &')
    try:
        send_signal(leader.pid, signal.SIGUSR1)
        assert leader.wait(100) == -signal.SIGUSR1
        assert len(living_members(leader.pid)) == 1
    finally:
        send_signal(leader.pid, signal.SIGKILL)
        leader.wait()


def test_signal_to_what_has_ended() -> None:
    """A group that is gone is no error."""
    child = subprocess.Popen(['true'], start_new_session=True)
    child.wait()
    send_signal(child.pid, signal.SIGINT)
    assert is_empty(child.pid)


def test_guards_end_at_a_word() -> None:
    """When the launch has ended all itself, the guards leave everything alone."""
    leader = _group_leader('sleep 60 &')
    guard = _guard()
    try:
        guard.add(leader.pid)
        (pid,) = guard.pids
        guard.close()
        assert guard.pids == [] and not os.path.exists(f'/proc/{pid}')
        assert leader.poll() is None
    finally:
        send_signal(leader.pid, signal.SIGKILL)
        leader.wait()


@pytest.mark.parametrize('number', [signal.SIGKILL, signal.SIGSTOP])
def test_guard_that_was_killed_or_stopped(number: signal.Signals) -> None:
    """Losing a guard does not disturb the launch, nor does one that does not listen."""
    guard = _guard()
    (pid,) = guard.pids
    os.kill(pid, number)
    os.waitid(os.P_PID, pid, os.WEXITED | os.WSTOPPED | os.WNOWAIT)
    for group in range(10_000):
        guard.add(group)
    guard.close()
    assert guard.pids == []


def _guard() -> OrphanGuard:
    guard = OrphanGuard(Family.of_new_run())
    guard.start()
    return guard
