# SPDX-License-Identifier: Apache-2.0
"""What a failing process leaves on the screen, and in the status of the launch."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
import logging
from typing import Any

from launch import Action, LaunchContext, LaunchDescription, LaunchService
from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    LogInfo,
    RegisterEventHandler,
    Shutdown,
    TimerAction,
)
from launch.event_handlers import OnProcessStart
from launch.events import matches_action
from launch.events.process import ShutdownProcess
from launch.logging._handlers import label_formatter
from launch.logging._screen import screen
from launch.substitutions import LaunchConfiguration
import pytest

Run = Callable[..., Any]


def _shell(text: str, **kwargs: Any) -> ExecuteProcess:
    return ExecuteProcess(cmd=['sh', '-c', text], **kwargs)


def _first_failure(*entities: Any) -> Any:
    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription(entities))
    assert service.run() == 0
    return service.context.run.first_failure


def test_last_lines_of_a_process_that_died(run: Run) -> None:
    """What was only in the log follows the line about the death: the last 20 lines, once."""
    lines = run(_shell('seq 30; echo seen >&2; exit 3', name='it')).lines
    died = next(line for line in lines if 'process has died' in line)
    label = died.partition('[it')[2].partition(']')[0]
    assert lines[-20:] == [f'    [it{label}] {number}' for number in range(11, 31)]
    assert lines[-21] == died
    assert sum('seen' in line for line in lines) == 2  # itself, and in the command line


@pytest.mark.parametrize('end', ['exit 0', 'exit 1'])
def test_no_last_lines(run: Run, end: str) -> None:
    """Nothing is repeated that was on the screen, nor of a process that ended well."""
    output = 'screen' if end == 'exit 1' else 'log'
    assert '\n    [' not in run(_shell(f'echo word; {end}', output=output)).text


def test_no_last_lines_of_what_was_shut_down(run: Run) -> None:
    """A process that the launch itself has ended shows nothing more."""
    process = _shell('echo word; exec sleep 60')
    result = run(process, TimerAction(period=0.5, actions=[Shutdown()]), noninteractive=True)
    assert 'process has died' in result.text and '\n    [' not in result.text


def test_status_of_the_first_failure() -> None:
    """The first process that fails counts; a signal is 128 and its number."""
    assert _first_failure(_shell('exit 3'), _shell('sleep 0.5; exit 4')) == 3
    assert _first_failure(_shell('kill -9 $$')) == 137
    assert _first_failure(_shell('exit 0')) is None


def test_what_the_launch_ends_is_no_failure() -> None:
    """A process that is told to end does not count."""
    process = _shell('exec sleep 60')
    stop = EmitEvent(event=ShutdownProcess(process_matcher=matches_action(process)))
    handler = RegisterEventHandler(OnProcessStart(target_action=process, on_start=[stop]))
    assert _first_failure(handler, process) is None


def test_colour_of_the_label(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a terminal the label at the beginning has a colour that depends on its number."""
    monkeypatch.setattr(screen, 'has_colours', lambda: True)
    record = logging.makeLogRecord({'msg': '[talker-1] a [talker-1]'})
    assert label_formatter('talker-1').format(record) == '\x1b[32m[talker-1]\x1b[0m a [talker-1]'
    record = logging.makeLogRecord({'msg': 'bare [talker-1]'})
    assert label_formatter('talker-1').format(record) == 'bare [talker-1]'


@pytest.mark.parametrize(
    'name, value, expected',
    [('NO_COLOR', '', True), ('NO_COLOR', '1', False), ('RCUTILS_COLORIZED_OUTPUT', '0', False)],
)
def test_when_there_are_colours(
    monkeypatch: pytest.MonkeyPatch, name: str, value: str, expected: bool
) -> None:
    """A terminal has colours unless they are refused; anything else has none."""
    monkeypatch.delenv('NO_COLOR', raising=False)
    monkeypatch.delenv('RCUTILS_COLORIZED_OUTPUT', raising=False)
    assert not screen.has_colours()
    monkeypatch.setenv(name, value)
    monkeypatch.setattr('sys.stdout.isatty', lambda: True, raising=False)
    assert screen.has_colours() is expected


def test_place_of_an_action_that_launch_has_made(run: Run) -> None:
    """It is the line of the action that brings it in, never one of Python's event loop."""

    class Bringing(Action):
        """Brings in an action that has no line of its own, as those of launch itself."""

        def execute(self, context: LaunchContext) -> list[Any]:
            failing = LogInfo(msg=LaunchConfiguration('unset'))
            failing.call_site = None
            return [failing]

    entity = Bringing()
    result = run(entity)
    assert result.status == 1
    assert f'It comes from {entity.call_site} (LogInfo)' in result.text


def test_line_of_an_action_that_python_creates() -> None:
    """A line of Python's own library is nobody's launch file."""
    with ThreadPoolExecutor() as pool:
        assert pool.submit(LogInfo, msg='x').result().call_site is None
