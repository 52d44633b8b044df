# SPDX-License-Identifier: Apache-2.0
"""The template process: when there is one, and what happens if it fails."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterator
import os
from pathlib import Path
import re
import signal
import sys
import time
from typing import Any

from launch._supervision.family import Family
from launch._supervision.orphan_guard import OrphanGuard
from launch._supervision.prefork import prefork as prefork_module
from launch._supervision.prefork import template_handle
from launch._supervision.prefork.prefork import Prefork, WORTHWHILE
from launch._supervision.process_group import living_members
from launch._supervision.program import Child, execute, Program
from launch.actions import ExecuteProcess, Shutdown, TimerAction
import pytest

# No link: a path with spaces cannot stand in the first line of a script.
INTERPRETER = Path(sys.executable).parent.resolve() / 'python3'
PRELOADER = """
import os, time
EARLY_VARIABLES = frozenset()
def preload(scripts): {}
def before_fork(): pass
def after_fork(): pass
"""
# Only a program that was forked has something below its first line on the stack.
HEAD = f"""#!{INTERPRETER}
import os, signal, sys, time
print('forked' if sys._getframe().f_back else 'executed', flush=True)
"""
Write = Callable[[str, str], str]
Wait = Callable[..., None]


class Forkable(ExecuteProcess):
    """A process that may be forked."""

    preloader = 'plain_preload'


@pytest.fixture
def script(write: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., str]:
    """Return a function that writes a script and what is imported for it."""
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setenv(
        'PYTHONPATH', os.pathsep.join((str(tmp_path), os.environ.get('PYTHONPATH', '')))
    )

    def write_both(text: str = '', preload: str = 'pass') -> str:
        write('plain_preload.py', PRELOADER.format(preload))
        path = write('script', HEAD + text)
        os.chmod(path, 0o755)
        return path

    return write_both


@pytest.fixture
def in_prefork(
    no_child_is_left: None,
) -> Iterator[Callable[[Callable[[Prefork], Awaitable[Any]]], Any]]:
    """Return a function that runs a coroutine function; it leaves nothing behind."""
    before = len(os.listdir('/proc/self/fd'))

    def run(use: Callable[[Prefork], Awaitable[Any]]) -> Any:
        async def main() -> Any:
            guard = OrphanGuard(Family.of_new_run())
            prefork = Prefork(guard)
            try:
                return await use(prefork)
            finally:
                prefork.close()
                guard.close()

        return asyncio.run(main())

    yield run
    assert len(os.listdir('/proc/self/fd')) == before


InPrefork = Callable[[Callable[[Prefork], Awaitable[Any]]], Any]


async def _starts(prefork: Prefork, script: str, count: int = WORTHWHILE) -> list[str]:
    """Start programs at the same time; return how each was started."""
    program = Program([script], None, None, False, 'plain_preload')
    return list(await asyncio.gather(*[_how(prefork, program) for _ in range(count)]))


async def _how(prefork: Prefork, program: Program) -> str:
    reader, writer = os.pipe()
    child: Child = await prefork.spawn(program, writer, writer)
    os.close(writer)
    with os.fdopen(reader) as file:
        text = await asyncio.get_running_loop().run_in_executor(None, file.read)
    assert child.wait() == 0 and child.stdin is not None
    child.stdin.close()
    return text.strip()


def test_few_are_executed(in_prefork: InPrefork, script: Callable[..., str]) -> None:
    """A template is not worth it for a few programs, but there for all that comes later."""

    async def use(prefork: Prefork) -> list[list[str]]:
        counts = (WORTHWHILE - 1, WORTHWHILE, 1)
        return [await _starts(prefork, path, count) for count in counts]

    path = script()
    few, enough, one = in_prefork(use)
    assert (set(few), set(enough), one) == ({'executed'}, {'forked'}, ['forked'])


def test_template_that_nobody_asks_any_longer(
    in_prefork: InPrefork, script: Callable[..., str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It ends, as its memory is of no use; what is started later is executed."""
    monkeypatch.setattr(template_handle, 'IDLE_S', 0.0)

    async def use(prefork: Prefork) -> tuple[list[str], list[str]]:
        first = await _starts(prefork, path)
        while prefork._template is not None and prefork._template.is_open:
            await asyncio.sleep(0.01)
        return first, await _starts(prefork, path, 1)

    path = script()
    first, later = in_prefork(use)
    assert 'forked' in first and later == ['executed']


def test_order_of_what_is_executed(
    in_prefork: InPrefork, script: Callable[..., str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What cannot be forked does not overtake what waits for the decision."""
    commands = []

    async def execute_noting(program: Program, stdout: int, stderr: int) -> Child:
        commands.append(program.command[0])
        return await execute(program, stdout, stderr)

    async def use(prefork: Prefork) -> None:
        first = Program([script()], None, None, False, 'plain_preload')
        second = Program(['true'], None, None, False, None)
        await asyncio.gather(_how(prefork, first), _how(prefork, second))

    monkeypatch.setattr(prefork_module, 'execute', execute_noting)
    in_prefork(use)
    assert [os.path.basename(command) for command in commands] == ['script', 'true']


@pytest.mark.parametrize(
    'preload', ['1/0', 'os._exit(3)', 'os.abort()', 'os.kill(os.getpid(), 9)']
)
def test_template_that_fails(
    in_prefork: InPrefork, script: Callable[..., str], preload: str
) -> None:
    """If nothing can be forked, all is executed, now and later."""
    path = script(preload=preload)

    async def use(prefork: Prefork) -> list[list[str]]:
        return [await _starts(prefork, path) for _ in range(2)]

    assert in_prefork(use) == [['executed'] * WORTHWHILE] * 2


def test_slow_template(
    in_prefork: InPrefork, script: Callable[..., str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing waits for ever."""
    monkeypatch.setattr(template_handle, '_PATIENCE_S', 0.3)
    path = script(preload='time.sleep(600)')
    assert in_prefork(lambda prefork: _starts(prefork, path)) == ['executed'] * WORTHWHILE


@pytest.mark.parametrize('number', [signal.SIGKILL, signal.SIGSTOP])
def test_template_that_is_lost(
    in_prefork: InPrefork,
    script: Callable[..., str],
    monkeypatch: pytest.MonkeyPatch,
    number: signal.Signals,
) -> None:
    """A template that is killed or stopped later on is done without."""
    path = script()

    async def use(prefork: Prefork) -> list[list[str]]:
        first = await _starts(prefork, path)
        template = prefork._template
        assert template is not None
        os.killpg(template.group, number)
        monkeypatch.setattr(template_handle, '_PATIENCE_S', 1.0)
        return [first, await _starts(prefork, path)]

    assert in_prefork(use) == [['forked'] * WORTHWHILE, ['executed'] * WORTHWHILE]


def test_switch(run: Callable[..., Any], script: Callable[..., str]) -> None:
    """A launch forks what is alike, unless it is told not to."""
    path = script()
    for prefork, how in ((True, 'forked'), (False, 'executed')):
        processes = [Forkable(cmd=[path], output='screen') for _ in range(WORTHWHILE)]
        result = run(*processes, prefork=prefork)
        assert (result.status, result.text.count(f'] {how}')) == (0, WORTHWHILE)


def test_shutdown_does_not_wait_for_a_template(
    run: Callable[..., Any], script: Callable[..., str]
) -> None:
    """A launch that is to end does not wait for what prepares its start."""
    path = script('time.sleep(60)', preload='time.sleep(60)')
    processes = [Forkable(cmd=[path]) for _ in range(WORTHWHILE)]
    began = time.monotonic()
    result = run(*processes, TimerAction(period=0.5, actions=[Shutdown()]))
    assert result.status == 0 and time.monotonic() - began < 15.0
    assert result.text.count('process has died') == WORTHWHILE


def test_respawn(run: Callable[..., Any], script: Callable[..., str]) -> None:
    """What is started again is forked again."""
    path = script('sys.exit(1)')
    result = run(
        *[Forkable(cmd=[path], output='screen') for _ in range(WORTHWHILE)],
        Forkable(cmd=[path], output='screen', respawn=True, respawn_max_retries=2),
    )
    assert result.text.count('] forked') == WORTHWHILE + 3
    assert result.text.count('exit code 1') == WORTHWHILE + 3


FOUR = """
*[type('Forkable', (ExecuteProcess,), {'preloader': 'plain_preload'})(
    cmd=['SCRIPT'], output='screen', sigterm_timeout='0.3', sigkill_timeout='0.3')
  for _ in range(4)]
"""


def _children(pid: int) -> list[int]:
    text = Path(f'/proc/{pid}/task/{pid}/children').read_text()
    return [int(word) for word in text.split()]


STUBBORN = """
import subprocess
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
subprocess.Popen(['sleep', '60'])
time.sleep(60)
"""


@pytest.mark.parametrize('number', [signal.SIGKILL, signal.SIGINT, signal.SIGTERM])
def test_end_of_the_launch(
    launcher: Callable[[str], Any], script: Callable[..., str], wait_until: Wait, number: int
) -> None:
    """However the launch ends, neither the template nor what it has become is left."""
    launch = launcher(FOUR.replace('SCRIPT', script(STUBBORN)))
    wait_until(lambda: launch.text.count('] forked') == 4, 30, 'four forked processes')
    groups = [int(pid) for pid in re.findall(r'started with pid \[(\d+)\]', launch.text)]
    children = _children(launch.process.pid)
    assert set(groups) < set(children)
    launch.process.send_signal(number)
    launch.process.wait(100)
    wait_until(lambda: not any(living_members(group) for group in groups))
    wait_until(lambda: not any(os.path.exists(f'/proc/{child}') for child in children))
