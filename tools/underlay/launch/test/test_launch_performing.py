# SPDX-License-Identifier: Apache-2.0
"""Substitutions of an action are performed once, when it is executed, and never later."""

from __future__ import annotations

from collections.abc import Callable
import signal
from typing import Any

from launch import LaunchContext, Substitution
from launch.actions import (
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
)
from launch.substitutions import LaunchConfiguration
import pytest

Run = Callable[..., Any]
Start = Callable[[str], Any]
Write = Callable[[str, str], str]

# What nav2_bringup does: an include in a group has an argument that says whether its nodes are
# started again, and the group is closed long before they end.
INCLUDED = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('use_respawn', default_value='False'),
        ExecuteProcess(cmd=['sh', '-c', 'echo run; exit 3'], output='screen',
                       respawn=LaunchConfiguration('use_respawn'), respawn_max_retries=2)])
"""


class Spy(Substitution):
    """A text that notes in which scope it is asked for."""

    def __init__(self, name: str, text: str, performed: list[tuple[str, str]]) -> None:
        """Note under a name; the scope is what the launch configuration `scope` says."""
        super().__init__()
        self._name = name
        self._text = text
        self._performed = performed

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        scope = context.launch_configurations.get('scope', 'none')
        self._performed.append((self._name, scope))
        return self._text


def _in_scope(*entities: Any, **configurations: str) -> GroupAction:
    settings = [SetLaunchConfiguration(name, value) for name, value in configurations.items()]
    return GroupAction([*settings, *entities])


@pytest.mark.parametrize('value, runs', [('False', 1), ('True', 3), ('0', 1), ('yes', 3)])
def test_respawn_in_an_include(run: Run, write: Write, value: str, runs: int) -> None:
    """Whether a process is started again was decided in the scope of its action."""
    path = write('included.launch.py', INCLUDED)
    result = run(
        _in_scope(IncludeLaunchDescription(path, launch_arguments={'use_respawn': value}.items())),
        ExecuteProcess(cmd=['sh', '-c', 'sleep 0.5; echo the other lives'], output='screen'),
    )
    assert 'Caught exception' not in result.text
    assert result.text.count('] run\n') == runs and '] the other lives\n' in result.text
    assert result.status == 0


def test_interrupt_after_the_end_in_a_scope(launcher: Start, write: Write) -> None:
    """The end of a process in an include leaves the launch alone, which ends as usual."""
    path = write('included.launch.py', INCLUDED)
    launch = launcher(
        f"GroupAction([IncludeLaunchDescription('{path}')]), "
        "ExecuteProcess(cmd=['sh', '-c', 'echo lives; exec sleep 60'], output='screen')"
    )
    launch.wait_for('process has died')
    launch.wait_for('] lives')
    launch.process.send_signal(signal.SIGINT)
    assert launch.end() == 0
    assert 'Caught exception' not in launch.text
    assert launch.text.count('process started') == 2


def test_timeouts_of_a_scope(launcher: Start) -> None:
    """The timeouts of a process are those of the scope in which it was started."""
    launch = launcher(
        "GroupAction([SetLaunchConfiguration('sigterm_timeout', '0.3'), "
        "SetLaunchConfiguration('soon', '0.2'), ExecuteProcess("
        """cmd=['sh', '-c', 'trap "" INT TERM; echo ready; while :; do sleep 0.1; done'], """
        "sigkill_timeout=substitutions.LaunchConfiguration('soon'), output='screen')])"
    )
    launch.wait_for('] ready')
    launch.process.send_signal(signal.SIGINT)
    assert launch.end() == 0
    assert "'0.3' seconds after receiving 'SIGINT'" in launch.text
    assert "'0.5' seconds after receiving 'SIGTERM'" in launch.text


@pytest.mark.parametrize('timeout', ['soon', LaunchConfiguration('unset')])
def test_timeout_that_cannot_be_used(run: Run, timeout: Any) -> None:
    """A timeout that is no number is an error before anything is started."""
    result = run(ExecuteProcess(cmd=['true'], name='it', sigkill_timeout=timeout))
    assert result.status == 1 and 'process started' not in result.text
    assert (
        "must be a number of seconds, but it is 'soon'" in result.text
        or "launch configuration 'unset' does not exist" in result.text
    )


def test_terminal_of_a_scope(run: Run) -> None:
    """A launch configuration in a group gives terminals to the processes of the group."""
    script = ['sh', '-c', 'test -t 1 && echo terminal || echo none']
    result = run(
        _in_scope(ExecuteProcess(cmd=script, output='screen', name='in'), emulate_tty='true'),
        ExecuteProcess(cmd=script, output='screen', name='out'),
    )
    found = {line.partition('-')[0]: line.split()[-1] for line in result.lines if line[0] == '['}
    assert (found['[in'], found['[out']) == ('terminal', 'none')


@pytest.mark.parametrize('value, seen', [('true', 'terminal'), ('0', 'none')])
def test_terminal_by_a_substitution(run: Run, value: str, seen: str) -> None:
    """Whether the output is a terminal may be said by a substitution."""
    script = ['sh', '-c', 'test -t 1 && echo terminal || echo none']
    wanted = LaunchConfiguration('wanted', default=value)
    result = run(ExecuteProcess(cmd=script, output='screen', emulate_tty=wanted))
    assert f'] {seen}\n' in result.text


def test_all_options_of_a_process(run: Run) -> None:
    """Each is performed exactly once, although the process starts, dies, respawns and is ended."""
    performed: list[tuple[str, str]] = []

    def spy(name: str, text: str) -> Spy:
        return Spy(name, text, performed)

    options = {
        'prefix': spy('prefix', 'env'),
        'name': spy('name', 'it'),
        'cwd': spy('cwd', '/'),
        'output': spy('output', 'screen'),
        'respawn': spy('respawn', 'true'),
        'emulate_tty': spy('emulate_tty', 'false'),
        'sigterm_timeout': spy('sigterm_timeout', '0.1'),
        'sigkill_timeout': spy('sigkill_timeout', '0.1'),
    }
    additional = {spy('variable', 'A'): spy('value', 'b')}
    words = [spy('program', 'sh'), '-c', spy('argument', 'trap "" INT TERM; sleep 0.2; exit 1')]
    action = ExecuteProcess(
        cmd=words,
        respawn_max_retries=1,
        additional_env=additional,
        **options,
    )
    result = run(_in_scope(action, scope='open'), TimerAction(period=0.3, actions=[Shutdown()]))
    assert result.status == 0
    names = [*options, 'variable', 'value', 'program', 'argument']
    assert sorted(performed) == sorted((name, 'open') for name in names)


def test_all_options_of_a_timer(run: Run) -> None:
    """A timer knows its period, and whether the shutdown ends it, when it is started."""
    performed: list[tuple[str, str]] = []
    period = Spy('period', '0.1', performed)
    cancel = Spy('cancel', 'true', performed)
    run(_in_scope(TimerAction(period=period, cancel_on_shutdown=cancel, actions=[]), scope='open'))
    assert sorted(performed) == [('cancel', 'open'), ('period', 'open')]
