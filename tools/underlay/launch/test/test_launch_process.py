# SPDX-License-Identifier: Apache-2.0
"""Processes: how they are started, and what becomes of their output and their end."""

from __future__ import annotations

from collections.abc import Callable
import os
from pathlib import Path
import sys
from typing import Any

from launch import LaunchContext
from launch.actions import (
    EmitEvent,
    ExecuteLocal,
    ExecuteProcess,
    LogInfo,
    RegisterEventHandler,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
)
from launch.descriptions import Executable
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from launch.events import matches_action
from launch.events.process import (
    matches_name,
    ProcessStdin,
    ShutdownProcess,
    SignalProcess,
)
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
import pytest

Run = Callable[..., Any]


def _shell(script: str, **kwargs: Any) -> ExecuteProcess:
    return ExecuteProcess(cmd=['sh', '-c', script], **{'output': 'screen', **kwargs})


def _prepared(context: LaunchContext, **kwargs: Any) -> ExecuteProcess:
    action = ExecuteProcess(**kwargs)
    action.prepare(context)
    return action


def _label_number(action: ExecuteProcess) -> int:
    return int(action.name.rpartition('-')[2])


# How a process is started.


def test_each_item_is_one_argument(context: LaunchContext) -> None:
    """Arguments are neither split nor dropped, and may have parts."""
    context.launch_configurations['x'] = 'a b'
    action = _prepared(
        context, cmd=['/bin/echo', '', LaunchConfiguration('x'), ['c', LaunchConfiguration('x')]]
    )
    assert action.cmd == ['/bin/echo', '', 'a b', 'ca b']


def test_labels_count_up(context: LaunchContext) -> None:
    """The label is the name, or that of the program, and a number for each process."""
    first = _prepared(context, cmd=['/bin/echo'])
    second = _prepared(context, cmd=['/bin/echo'], name=['my', 'echo'])
    assert first.name.rpartition('-')[0] == 'echo' and second.name.rpartition('-')[0] == 'myecho'
    assert _label_number(second) == _label_number(first) + 1


def test_prefix(context: LaunchContext) -> None:
    """A prefix is split like in a shell and gives the label its name."""
    action = _prepared(context, cmd=['echo', 'x'], prefix="nice -n '5'")
    assert action.cmd == ['nice', '-n', '5', 'echo', 'x'] and action.name.startswith('nice-')


@pytest.mark.parametrize('pattern, prefixed', [('ec', True), ('cho', False)])
def test_prefix_of_all_processes(context: LaunchContext, pattern: str, prefixed: bool) -> None:
    """A launch configuration gives a prefix to the programs whose names match a filter."""
    context.launch_configurations.update(
        {'launch-prefix': 'nice', 'launch-prefix-filter': pattern}
    )
    assert (_prepared(context, cmd=['/bin/echo']).cmd[0] == 'nice') is prefixed
    assert _prepared(context, cmd=['/bin/echo'], prefix='env').cmd[0] == 'env'


def test_environment(context: LaunchContext) -> None:
    """The environment is that of the visit, with additions, or only what is given."""
    os.environ['LAUNCH_TEST'] = 'a'
    inherited = _prepared(
        context,
        cmd=['x'],
        additional_env={'LAUNCH_MORE': ['b', EnvironmentVariable('LAUNCH_TEST')]},
    )
    given = _prepared(context, cmd=['x'], env={'A': 'b'}, additional_env={'C': 'd'})
    os.environ['LAUNCH_TEST'] = 'later'
    assert inherited.env['LAUNCH_TEST'] == 'a' and inherited.env['LAUNCH_MORE'] == 'ba'
    assert given.env == {'A': 'b', 'C': 'd'}


def test_python_is_unbuffered(context: LaunchContext, tmp_path: Path) -> None:
    """What runs Python shows its output at once, unless the user decides otherwise."""
    script = tmp_path / 'node'
    script.write_text('#!/usr/bin/env python3\n')
    os.environ.pop('PYTHONUNBUFFERED', None)
    for command in ([sys.executable], ['nice', str(script)], [str(script), '-x']):
        assert _prepared(context, cmd=command).env['PYTHONUNBUFFERED'] == '1'
    assert _prepared(context, cmd=[f'{script} x'], shell=True).env['PYTHONUNBUFFERED'] == '1'
    assert 'PYTHONUNBUFFERED' not in _prepared(context, cmd=['echo', 'x']).env
    os.environ['PYTHONUNBUFFERED'] = ''
    assert _prepared(context, cmd=[sys.executable]).env['PYTHONUNBUFFERED'] == ''


def test_empty_command(context: LaunchContext) -> None:
    """A command needs a program."""
    with pytest.raises(ValueError, match='needs a program'):
        _prepared(context, cmd=[])


def test_unknown_keyword() -> None:
    """A keyword that there is not is refused at once."""
    with pytest.raises(TypeError, match='unknown'):
        ExecuteProcess(cmd=['x'], unknown=1)


def test_folder_and_shell(run: Run, tmp_path: Path) -> None:
    """A shell reads the words joined by spaces, in the folder that is given."""
    result = run(
        ExecuteProcess(
            cmd=['echo "$(pwd)"', '$((1 + 1))'],
            shell=True,
            cwd=tmp_path,
            output='screen',
            name='it',
        )
    )
    assert f'] {tmp_path} 2' in result.text


def test_execute_local(run: Run) -> None:
    """A description of a program can be executed by itself."""
    description = Executable(cmd=['echo'], arguments=['x'])
    assert '] x\n' in run(ExecuteLocal(process_description=description, output='screen')).text
    with pytest.raises(TypeError, match="'arguments' must be a list of words"):
        Executable(cmd=['echo'], arguments='x')


def test_process_starts_after_the_walk(run: Run) -> None:
    """All that is visited comes before the first start; the environment is that of the visit."""
    result = run(
        SetEnvironmentVariable('LAUNCH_TEST', 'early'),
        _shell('echo $LAUNCH_TEST'),
        SetEnvironmentVariable('LAUNCH_TEST', 'late'),
        LogInfo(msg='walk'),
    )
    assert result.lines[0] == '[INFO] [launch.user]: walk'
    assert '] early\n' in result.text


def test_executed_twice(run: Run) -> None:
    """One action is one process."""
    action = ExecuteProcess(cmd=['true'])
    result = run(action, action)
    assert result.status == 1 and 'executed more than once' in result.text


@pytest.mark.parametrize(
    'kwargs, text',
    [
        ({'cmd': ['no_such_program']}, "the program 'no_such_program' was not found on the PATH"),
        ({'cmd': ['/no/program']}, "the program '/no/program' does not exist"),
        ({'cmd': ['true'], 'cwd': '/no'}, "the folder '/no', in which 'true' was to be started"),
    ],
)
def test_spawn_failures(run: Run, monkeypatch: pytest.MonkeyPatch, kwargs: Any, text: str) -> None:
    """Without the check in advance such a process is only reported; the launch goes on."""
    monkeypatch.setenv('LAUNCH_PREFLIGHT', '0')
    seen: list[Any] = []
    result = run(
        ExecuteProcess(**kwargs),
        RegisterEventHandler(OnProcessExit(on_exit=lambda event, context: seen.append(event))),
    )
    assert (result.status, seen) == (0, [])
    assert f'exception occurred while executing process: {text}' in result.text


@pytest.mark.parametrize(
    'mode, text',
    [
        (0o644, "is not executable; 'chmod +x' makes it so"),
        (0o755, 'is a script whose first line does not name an interpreter'),
    ],
)
def test_file_that_is_no_program(run: Run, tmp_path: Path, mode: int, text: str) -> None:
    """The log tells what a file lacks to be a program."""
    path = tmp_path / 'script'
    path.write_text('echo x')
    path.chmod(mode)
    assert f"'{path}' {text}" in run(ExecuteProcess(cmd=[path])).text


# Output.


def _where_it_goes(run: Run, tmp_path: Path, output: Any) -> str:
    """Return letters for where the standard output and error of a process have gone."""
    text = run(_shell('echo out; echo err >&2', output=output, name='it')).text
    folder = tmp_path / 'log' / 'latest'
    main = (folder / 'launch.log').read_text()
    own = {
        path.name.partition('.')[0].rpartition('-')[2]: path.read_text()
        for path in folder.glob('it-*.log')
    }
    found = ''
    for word in ('out', 'err'):
        found += 'S' * (f'] {word}\n' in text) + 'L' * (f'] {word}\n' in main)
        found += 'O' * (f'] {word}\n' in own.get(f'std{word}', ''))
        found += 'B' * any(f'] {word}\n' in body for name, body in own.items() if name.isdigit())
        found += ' '
    return found.strip(' ') if found.strip() else found


@pytest.mark.parametrize(
    'output, where',
    [
        ('log', 'L SL'),
        ('screen', 'S S'),
        ('both', 'SL SL'),
        ('own_log', 'OB OB'),
        ('full', 'SLOB SLOB'),
        ({'stdout': 'screen', 'stderr': 'log'}, 'S L'),
        ({'both': ['log', 'own_log'], 'stderr': 'screen'}, 'LB SLB'),
        ([LaunchConfiguration('o', default='both')], 'SL SL'),
    ],
)
def test_output(run: Run, tmp_path: Path, output: Any, where: str) -> None:
    """Each stream goes to the screen, to the main log and to own logs, as it is set."""
    assert _where_it_goes(run, tmp_path, output) == where


def test_output_is_overridden(run: Run, tmp_path: Path) -> None:
    """An environment variable sets the output of all processes."""
    os.environ['OVERRIDE_LAUNCH_PROCESS_OUTPUT'] = 'both'
    assert _where_it_goes(run, tmp_path, 'log') == 'SL SL'


@pytest.mark.parametrize('output', ['nonsense', {'stdout': 'nonsense'}, {'stdin': 'screen'}])
def test_wrong_output(run: Run, output: Any) -> None:
    """An output that there is not is an error."""
    result = run(ExecuteProcess(cmd=['true'], output=output))
    assert result.status == 1
    assert 'is not a valid standard output config' in result.text or 'not a stream' in result.text


def test_lines_are_whole(run: Run) -> None:
    """A line is written when it is complete; the rest when the process has ended."""
    result = run(_shell(r'printf a; sleep 0.05; printf "b\nc\303"', output_format='<{line}>'))
    assert [line for line in result.lines if line.startswith('<')] == ['<ab>', '<c\ufffd>']


def test_many_lines(run: Run) -> None:
    """Nothing is lost when a process ends right after it has written a lot."""
    result = run(_shell('seq 1 20000', output_format='{line}'))
    numbers = [line for line in result.lines if line.isdigit()]
    assert numbers == [str(number) for number in range(1, 20001)]


def test_cached_output(run: Run) -> None:
    """The output can be kept, byte for byte."""
    action = _shell(r'printf "a\nb"; printf e >&2', cached_output=True)
    run(action)
    assert (action.get_stdout(), action.get_stderr(), action.return_code) == ('a\nb', 'e', 0)
    with pytest.raises(RuntimeError, match='cached_output=True'):
        ExecuteProcess(cmd=['x']).get_stdout()


@pytest.mark.parametrize(
    'kwargs, configuration, terminal',
    [
        ({}, None, False),
        ({'emulate_tty': True}, None, True),
        ({}, 'true', True),
        ({'emulate_tty': True}, 'false', False),
    ],
)
def test_terminal(run: Run, kwargs: Any, configuration: Any, terminal: bool) -> None:
    """The output can be a terminal for the process; a launch configuration overrides it."""
    settings = (
        [] if configuration is None else [SetLaunchConfiguration('emulate_tty', configuration)]
    )
    script = 'test -t 1 && test -t 2 && echo yes || echo no'
    result = run(*settings, _shell(script, output_format='<{line}>', **kwargs))
    assert f'<{"yes" if terminal else "no"}>' in result.lines


def test_io_events(run: Run) -> None:
    """A handler gets the bytes of a stream, and may bring in more."""
    action = _shell('echo out; echo err >&2')
    seen: list[bytes] = []

    def on_stdout(event: Any) -> LogInfo:
        seen.append(event.text)
        assert event.from_stdout and not event.from_stderr
        return LogInfo(msg='reaction')

    result = run(
        action,
        RegisterEventHandler(
            OnProcessIO(
                target_action=action,
                on_stdout=on_stdout,
                on_stderr=lambda event: seen.append(event.text),
            )
        ),
    )
    assert sorted(seen) == [b'err\n', b'out\n'] and 'reaction' in result.text


def test_standard_input(run: Run) -> None:
    """A process waits for input that an event may bring."""
    action = _shell('read line; echo "<$line>"')
    result = run(
        action,
        RegisterEventHandler(
            OnProcessStart(
                target_action=action,
                on_start=lambda event, context: EmitEvent(
                    event=ProcessStdin(
                        text=b'hello\n', action=action, name='', cmd=[], cwd=None, env=None, pid=0
                    )
                ),
            )
        ),
    )
    assert '] <hello>' in result.text


# The end.


def test_end_of_a_process(run: Run) -> None:
    """The log tells how a process ended; the launch does not fail because of it."""
    result = run(
        ExecuteProcess(cmd=['sh', '-c', 'exit 3'], name='bad', log_cmd=True),
        ExecuteProcess(cmd=['true'], name='good'),
    )
    assert result.status == 0
    assert ", exit code 3, cmd 'sh -c exit 3']." in result.text
    assert "process details: cmd='sh -c exit 3', cwd='None', custom_env?=True" in result.text
    assert 'process has finished cleanly [pid ' in result.text


def test_on_exit(run: Run) -> None:
    """The own reaction to the end comes after handlers that were registered later."""
    action = ExecuteProcess(cmd=['true'], on_exit=[LogInfo(msg='own')])
    result = run(
        action,
        RegisterEventHandler(
            OnProcessExit(
                target_action=action, on_exit=lambda event, context: LogInfo(msg='other')
            )
        ),
    )
    texts = [line for line in result.lines if 'launch.user' in line]
    assert texts == ['[INFO] [launch.user]: other', '[INFO] [launch.user]: own']


def test_required_process(run: Run) -> None:
    """The end of a required process ends the launch."""
    result = run(
        ExecuteProcess(cmd=['true'], name='needed', on_exit=Shutdown()),
        ExecuteProcess(cmd=['sleep', '60']),
    )
    assert '[INFO] [launch]: process[needed-' in result.text
    assert 'was required: shutting down launched system' in result.text


def test_empty_on_exit(run: Run) -> None:
    """An empty list of reactions is nothing special."""
    assert run(ExecuteProcess(cmd=['true'], on_exit=[])).status == 0


def test_respawn(run: Run) -> None:
    """A process is started again after a clean end too, as often as is allowed."""
    codes: list[int] = []
    result = run(
        _shell('exit 0', respawn=True, respawn_max_retries=2),
        RegisterEventHandler(
            OnProcessExit(on_exit=lambda event, context: codes.append(event.returncode))
        ),
    )
    assert codes == [0, 0, 0]
    labels = {line.split(']')[1] for line in result.lines if 'started' in line}
    assert len(labels) == 1


def test_shutdown_cuts_the_wait_before_a_respawn(run: Run) -> None:
    """A process that waits for its next start is not started during the shutdown."""
    result = run(
        _shell('exit 1', respawn='true', respawn_delay=60.0),
        TimerAction(period=0.3, actions=[Shutdown()]),
    )
    assert result.text.count('process started') == 1


def test_signal_event(run: Run) -> None:
    """An event sends a signal to the processes that match."""
    action = ExecuteProcess(cmd=['sleep', '60'], name='it')
    result = run(
        action,
        TimerAction(
            period=0.1,
            actions=[
                EmitEvent(
                    event=SignalProcess(
                        signal_number='SIGTERM',
                        process_matcher=lambda each: matches_name(action.name)(each),
                    )
                )
            ],
        ),
    )
    assert "sending signal 'SIGTERM' to process[it-" in result.text
    assert 'exit code -15' in result.text


def test_signal_before_the_start(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """A process that is not running cannot get a signal."""
    monkeypatch.setenv('LAUNCH_PREFLIGHT', '0')
    action = ExecuteProcess(cmd=['no_such_program'])
    result = run(
        action,
        TimerAction(
            period=0.1,
            actions=[
                EmitEvent(
                    event=SignalProcess(signal_number=2, process_matcher=matches_action(action))
                )
            ],
        ),
    )
    assert result.status == 1 and 'is not running' in result.text


def test_shutdown_of_one_process(run: Run) -> None:
    """A process that is ended by an event is not started again; others go on."""
    action = ExecuteProcess(cmd=['sleep', '60'], respawn=True)
    other = _shell('sleep 0.5; echo other')
    result = run(
        action,
        other,
        RegisterEventHandler(
            OnProcessStart(
                target_action=action,
                on_start=[
                    EmitEvent(event=ShutdownProcess(process_matcher=matches_action(action)))
                ],
            )
        ),
    )
    assert result.text.count('process started') == 2
    assert '] other' in result.text


def test_events_know_the_process(run: Run) -> None:
    """The events of a process carry the facts about it."""
    seen: list[Any] = []
    action = ExecuteProcess(cmd=['true'], name='it', additional_env={'A': 'b'})
    run(
        action,
        RegisterEventHandler(
            OnProcessStart(
                target_action=lambda target: target is action,
                on_start=lambda event, context: seen.append(event),
            )
        ),
    )
    event = seen[0]
    assert (event.process_name, event.cmd, event.cwd, event.env['A'], event.action) == (
        action.name,
        ['true'],
        None,
        'b',
        action,
    )
    assert event.pid == (action.process_details or {})['pid']
