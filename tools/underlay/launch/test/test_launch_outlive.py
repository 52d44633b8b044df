# SPDX-License-Identifier: Apache-2.0
"""Nothing outlives its launch, wherever it hides and however the launch ends."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import os
from pathlib import Path
import re
import shlex
import signal
import subprocess
import sys
import threading
from typing import Any

import pytest

Start = Callable[[str], Any]
Wait = Callable[..., None]

# Each kind of process that leaves its group. Whoever stays writes a file of its name.
STUB = """
import os, signal, sys, time

def stay(name, ignores=False):
    if ignores:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
    open(os.path.join(os.path.dirname(__file__), 'ready-' + name), 'w').close()
    time.sleep(600)

def fork(child):
    if os.fork() == 0:
        child()
        os._exit(0)

def daemon(then):
    ours, theirs = os.pipe()
    def lead():
        os.setsid()
        os.close(theirs)
        fork(then)
    fork(lead)
    os.close(theirs)
    os.read(ours, 1)  # what is still in the group when its leader ends, the launch ends
    os.close(ours)

signal.signal(signal.SIGINT, signal.SIG_DFL)  # without a traceback
kind = sys.argv[1]
again = [sys.executable, '-I', '-S', *sys.argv[:1], 'plain', kind]
if kind == 'plain':
    stay(sys.argv[2])
elif kind == 'group':
    fork(lambda: (os.setpgid(0, 0), stay(kind)))
    time.sleep(600)
elif kind == 'session':
    fork(lambda: (os.setsid(), stay(kind)))
    time.sleep(600)
elif kind == 'daemon':
    daemon(lambda: stay(kind, ignores=True))
    time.sleep(600)
elif kind == 'orphan':
    daemon(lambda: stay(kind))
elif kind == 'bare':
    daemon(lambda: os.execve(again[0], again, {}))
elif kind == 'stopped':
    daemon(lambda: (open(__file__ + '.pid', 'w').write(str(os.getpid())), stay(kind)))
elif kind == 'many':
    for number in range(300):
        daemon(lambda: stay(f'many{number}') if number == 299 else time.sleep(600))
"""
KINDS = ('group', 'session', 'daemon', 'orphan', 'bare', 'stopped')
SHELLS = {
    'timeout': 'timeout 600 $stub plain timeout; true',
    'setsid': 'setsid -w $stub plain setsid; true',
    'jobs': 'set -m; $stub plain jobs & wait',
    'nohup': 'nohup setsid $stub plain nohup > /dev/null 2>&1 & wait',
}
TIMEOUTS = "'sigterm_timeout': '1.5', 'sigkill_timeout': '0.5'"


class Stubs:
    """The processes of a test that leave their groups."""

    def __init__(self, folder: Path) -> None:
        """Write their program."""
        self.path = folder / 'stub.py'
        self.path.write_text(STUB)
        self._word = os.fsencode(self.path)

    def process(self, kind: str) -> str:
        """Return the action that starts a kind, as it is written in a launch file."""
        command = [sys.executable, '-I', '-S', str(self.path)]
        words = [*command, kind]
        if kind in SHELLS:
            words = ['bash', '-c', SHELLS[kind].replace('$stub', shlex.join(command))]
        return f'ExecuteProcess(cmd={words!r}, output="screen", **{{{TIMEOUTS}}})'

    def processes(self, kinds: tuple[str, ...]) -> str:
        """Return the actions that start several kinds."""
        return ', '.join(map(self.process, kinds))

    def are_ready(self, kinds: tuple[str, ...]) -> bool:
        """Return whether all have begun to wait."""
        return all(self.path.with_name(f'ready-{kind}').exists() for kind in kinds)

    def stop_one(self) -> None:
        """Stop the one that waits for this."""
        os.kill(int(self.path.with_name('stub.py.pid').read_text()), signal.SIGSTOP)

    def living(self) -> list[int]:
        """Return the ids of those that live."""
        return [pid for pid in _all_pids() if self._is_one(pid)]

    def _is_one(self, pid: int) -> bool:
        """Return whether this is one of them, and neither a shell nor a wrapper around one."""
        words = _command_line(pid).split(b'\0')
        return os.path.basename(words[0]).startswith(b'python') and words[3:4] == [self._word]


def _all_pids() -> list[int]:
    return [int(name) for name in os.listdir('/proc') if name.isdigit()]


def _command_line(pid: int) -> bytes:
    try:
        return Path(f'/proc/{pid}/cmdline').read_bytes()
    except OSError:
        return b''


@pytest.fixture
def stubs(tmp_path: Path) -> Iterator[Stubs]:
    """Return the processes that leave their groups; a test that fails leaves none of them."""
    stubs = Stubs(tmp_path)
    yield stubs
    for pid in stubs.living():
        os.kill(pid, signal.SIGKILL)


def _guards(launch: Any) -> list[int]:
    """Return the ids of the processes that watch over a launch."""
    pid = launch.process.pid
    return [p for p in _all_pids() if b'cleanup.py' in _command_line(p) and _parent(p) == pid]


def _parent(pid: int) -> int:
    try:
        return int(Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()[1])
    except OSError:
        return 0


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_whatever_leaves_its_group(
    launcher: Start, stubs: Stubs, wait_until: Wait, number: signal.Signals
) -> None:
    """When a launch has ended, nothing is left; when it was killed, soon nothing is left."""
    kinds = (*KINDS, *SHELLS)
    launch = launcher(stubs.processes(kinds))
    wait_until(lambda: stubs.are_ready(kinds))
    stubs.stop_one()
    launch.process.send_signal(number)
    if number == signal.SIGKILL:
        assert launch.end() == -signal.SIGKILL
        wait_until(lambda: not stubs.living())
    else:
        assert launch.end() == 0
        assert stubs.living() == []
        assert 'Traceback' not in launch.text and 'could not end' not in launch.text


def test_a_launch_that_ends_by_itself(launcher: Start, stubs: Stubs) -> None:
    """A daemon whose parent has ended lives as long as the launch, and no longer."""
    ready = stubs.path.with_name('ready-orphan')
    entities = f"ExecuteProcess(cmd=['sh', '-c', 'until [ -e {ready} ]; do sleep 0.05; done'])"
    launch = launcher(f'{stubs.process("orphan")}, {entities}')
    assert launch.end() == 0
    assert ready.exists() and stubs.living() == []
    assert re.search(
        r"sending signal 'SIGINT' to what has left .*: python\S* \[\d+\]", launch.text
    )


def test_no_signal_to_whatever_behaves(launcher: Start) -> None:
    """A launch whose processes leave nothing behind says nothing about that."""
    launch = launcher("ExecuteProcess(cmd=['true'])")
    assert launch.end() == 0 and 'what has left' not in launch.text


def test_hundreds(launcher: Start, stubs: Stubs, wait_until: Wait) -> None:
    """Hundreds of daemons end too, although they do not fit into the watch at once."""
    launch = launcher(stubs.process('many'))
    wait_until(lambda: stubs.are_ready(('many299',)))
    launch.process.send_signal(signal.SIGINT)
    assert launch.end() == 0
    assert stubs.living() == []


def test_process_that_is_shut_down_alone(
    run: Callable[..., Any], stubs: Stubs, wait_until: Wait
) -> None:
    """What a process has started outside of its group ends with it, what others have does not."""
    from launch.actions import EmitEvent, ExecuteProcess, OpaqueFunction, Shutdown, TimerAction
    from launch.events.process import ShutdownProcess

    command = [sys.executable, '-I', '-S', str(stubs.path)]
    left: list[int] = []

    def at_end(event: Any, context: Any) -> Shutdown:
        wait_until(lambda: len(stubs.living()) == 2)
        left.extend(stubs.living())
        return Shutdown()

    def when_ready(context: Any) -> list[Any]:
        if not stubs.are_ready(('session', 'group')):
            return [TimerAction(period=0.05, actions=[OpaqueFunction(function=when_ready)])]
        return [EmitEvent(event=ShutdownProcess(process_matcher=lambda action: action is one))]

    one = ExecuteProcess(cmd=[*command, 'session'], on_exit=at_end)
    other = ExecuteProcess(cmd=[*command, 'group'])
    assert run(one, other, OpaqueFunction(function=when_ready)).status == 0
    assert len(left) == 2 and stubs.living() == []


# The guards.


def _launch_with_guards(launcher: Start, stubs: Stubs, wait_until: Wait) -> Any:
    kinds = ('session', 'daemon', 'bare')
    launch = launcher(stubs.processes(kinds))
    wait_until(lambda: stubs.are_ready(kinds) and len(_guards(launch)) == 2)
    # From then on the kernel wakes them if somebody stops them.
    wait_until(lambda: all(_flags_of_stdin(guard) & os.O_ASYNC for guard in _guards(launch)))
    return launch


def _flags_of_stdin(pid: int) -> int:
    lines = Path(f'/proc/{pid}/fdinfo/0').read_text().splitlines()
    return int(next(line for line in lines if line.startswith('flags:')).split()[1], 8)


def _is_stopped(pid: int) -> bool:
    try:
        return Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()[0] == 'T'
    except OSError:
        return False


def _kill(launch: Any, *others: int) -> None:
    for pid in (*others, launch.process.pid):
        os.kill(pid, signal.SIGKILL)
    launch.process.wait()


def test_each_guard_alone_is_enough(launcher: Start, stubs: Stubs, wait_until: Wait) -> None:
    """A guard that is killed at the same instant as the launch is not missed."""
    for which in (0, 1):
        launch = _launch_with_guards(launcher, stubs, wait_until)
        _kill(launch, sorted(_guards(launch))[which])
        wait_until(lambda: not stubs.living())
        for file in stubs.path.parent.glob('ready-*'):
            file.unlink()


def test_guards_that_were_stopped(launcher: Start, stubs: Stubs, wait_until: Wait) -> None:
    """Guards that someone has stopped are woken up when the launch is killed."""
    launch = _launch_with_guards(launcher, stubs, wait_until)
    guards = _guards(launch)
    for guard in guards:
        os.kill(guard, signal.SIGSTOP)
    wait_until(lambda: all(map(_is_stopped, guards)))
    _kill(launch)
    wait_until(lambda: not stubs.living() and not any(map(_is_stopped, guards)))


def test_guards_that_were_killed(launcher: Start, stubs: Stubs, wait_until: Wait) -> None:
    """Guards that someone has killed are replaced."""
    launch = _launch_with_guards(launcher, stubs, wait_until)
    before = set(_guards(launch))
    for guard in before:
        os.kill(guard, signal.SIGKILL)
    wait_until(lambda: len(set(_guards(launch)) - before) == 2)
    _kill(launch)
    wait_until(lambda: not stubs.living())


def test_launch_that_was_stopped_and_killed(
    launcher: Start, stubs: Stubs, wait_until: Wait
) -> None:
    """A launch that is stopped cannot replace its guard; the other one does the work."""
    launch = _launch_with_guards(launcher, stubs, wait_until)
    launch.process.send_signal(signal.SIGSTOP)
    _kill(launch, min(_guards(launch)))
    wait_until(lambda: not stubs.living())


def test_guards_go_with_the_launch(launcher: Start, stubs: Stubs, wait_until: Wait) -> None:
    """No guard is left when the launch has ended."""
    launch = _launch_with_guards(launcher, stubs, wait_until)
    guards = _guards(launch)
    launch.process.send_signal(signal.SIGINT)
    assert launch.end() == 0
    assert not any(os.path.exists(f'/proc/{guard}') for guard in guards)


# Launches in launches.


INNER = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess
def generate_launch_description():
    return LaunchDescription([{entities}])
"""


def _nested(write: Callable[[str, str], str], command: list[str], entities: str) -> str:
    path = write('inner.launch.py', INNER.format(entities=entities))
    return f'ExecuteProcess(cmd={[*command, path]!r}, output="screen")'


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGKILL])
def test_launch_in_a_launch(
    launcher: Start,
    launch_command: list[str],
    write: Callable[[str, str], str],
    stubs: Stubs,
    wait_until: Wait,
    number: signal.Signals,
) -> None:
    """The inner launch ends its own processes, once; the outer one leaves nothing all the same."""
    kinds = ('plain', 'session', 'bare')
    inner = stubs.processes(kinds[1:]) + ', ' + stubs.process('setsid')
    launch = launcher(_nested(write, launch_command, inner))
    wait_until(lambda: stubs.are_ready(('session', 'bare', 'setsid')))
    launch.process.send_signal(number)
    launch.end()
    wait_until(lambda: not stubs.living())
    assert 'again, ignoring' not in launch.text


def test_inner_launch_that_was_killed(
    launcher: Start,
    launch_command: list[str],
    write: Callable[[str, str], str],
    stubs: Stubs,
    wait_until: Wait,
) -> None:
    """What a killed launch has left ends although the launch around it goes on."""
    inner = stubs.processes(('session', 'bare'))
    outer = f'{_nested(write, launch_command, inner)}, {stubs.process("orphan")}'
    launch = launcher(f'{outer}, ExecuteProcess(cmd=["sleep", "60"])')
    wait_until(lambda: stubs.are_ready(('session', 'bare', 'orphan')))
    inner = os.fsencode(stubs.path.with_name('inner.launch.py'))
    inner_pids = [p for p in _all_pids() if _command_line(p).split(b'\0')[-2:-1] == [inner]]
    [leader] = [p for p in inner_pids if _parent(p) not in inner_pids]
    os.kill(leader, signal.SIGKILL)
    wait_until(lambda: len(stubs.living()) == 1)
    launch.process.send_signal(signal.SIGINT)
    assert launch.end() == 0 and stubs.living() == []


# What is not to end.


def test_detached_process(launcher: Start, stubs: Stubs, wait_until: Wait) -> None:
    """A process that is to outlive the launch does, with all that it starts, and its output."""
    lone = stubs.process('session').replace('output=', 'detached=True, output=')
    launch = launcher(f'{lone}, ExecuteProcess(cmd=["sleep", "60"])')
    wait_until(lambda: stubs.are_ready(('session',)))
    launch.process.send_signal(signal.SIGINT)
    assert launch.end() == 0
    assert len(stubs.living()) == 2 and 'process continues without the launch [pid' in launch.text


def test_detached_process_of_a_killed_launch(
    launcher: Start, stubs: Stubs, wait_until: Wait
) -> None:
    """A marker in the environment does the same, and for what a process starts as well."""
    text = 'ROS_LAUNCH_DETACHED=1 setsid $stub plain setsid & $stub plain nohup'
    command = shlex.join([sys.executable, '-I', '-S', str(stubs.path)])
    script = text.replace('$stub', command)
    launch = launcher(
        f"ExecuteProcess(cmd=['bash', '-c', {script!r}]), "
        + stubs.process('orphan').replace(
            'output=', 'additional_env={"ROS_LAUNCH_DETACHED": "1"}, output='
        )
    )
    wait_until(
        lambda: stubs.are_ready(('orphan', 'setsid', 'nohup')),
        message=lambda: f'{os.listdir(stubs.path.parent)}, {stubs.living()}, {launch.text}',
    )
    assert len(stubs.living()) >= 3
    _kill(launch)
    wait_until(lambda: len(stubs.living()) == 2)


def test_output_of_a_detached_process(run: Callable[..., Any], tmp_path: Path) -> None:
    """A detached process writes to a file of the log; the launch waits for it if it may."""
    from launch.actions import ExecuteProcess

    action = ExecuteProcess(cmd=['sh', '-c', 'cat; echo out; echo err >&2'], detached=True)
    assert run(action).status == 0 and action.return_code == 0
    (path,) = (tmp_path / 'log').glob(f'*-{os.getpid()}/sh-*.log')
    assert path.read_text() == 'out\nerr\n'


def test_processes_of_the_program_that_launches(run: Callable[..., Any]) -> None:
    """What a user's program starts itself is no business of the launch, whenever that was."""
    from launch.actions import ExecuteProcess, OpaqueFunction

    def start() -> subprocess.Popen[bytes]:
        return subprocess.Popen(['sleep', '60'], start_new_session=True)

    own = [start()]
    limit = Path('/proc/self/limits').read_text()
    try:
        thread = threading.Thread(target=lambda: own.append(start()))
        run(
            OpaqueFunction(function=lambda context: thread.start()),
            ExecuteProcess(cmd=['true']),
            OpaqueFunction(function=lambda context: thread.join()),
        )
        assert len(own) == 2 and all(process.poll() is None for process in own)
        assert Path('/proc/self/limits').read_text() == limit
    finally:
        for process in own:
            process.kill()
            process.wait()


# Files.


def test_files_for_processes(launcher: Start, wait_until: Wait, tmp_path: Path) -> None:
    """Temporary files go with the launch that they were written for, also if it is killed."""
    write_it = (
        "OpaqueFunction(function=lambda context: __import__('ros_environment.temporary_files')"
        ".temporary_files.write_temporary_file('launch_params_', 'x') and None)"
    )
    os.environ['TMPDIR'] = str(tmp_path / 'tmp')
    (tmp_path / 'tmp').mkdir()
    for number in (signal.SIGINT, signal.SIGKILL):
        launch = launcher(
            f"{write_it}, ExecuteProcess(cmd=['sh', '-c', 'echo ready; exec sleep 60'],"
            " output='screen')"
        )
        launch.wait_for('] ready')
        assert len(list((tmp_path / 'tmp').iterdir())) == 1
        launch.process.send_signal(number)
        launch.end()
        wait_until(lambda: not list((tmp_path / 'tmp').iterdir()))
