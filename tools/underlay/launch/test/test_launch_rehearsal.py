# SPDX-License-Identifier: Apache-2.0
"""Rehearsals: all is visited, nothing is started."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from launch import LaunchDescription, LaunchIntrospector, LaunchService
from launch.actions import (
    DeclareLaunchArgument,
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueCoroutine,
    OpaqueFunction,
    RegisterEventHandler,
    SetEnvironmentVariable,
    TimerAction,
)
from launch.conditions import IfCondition
from launch.dry_run import rehearse
from launch.dry_run_record import Record, tree_lines
from launch.event_handlers import OnProcessExit, OnProcessIO, OnShutdown
from launch.events import Shutdown
from launch.substitutions import Command, LaunchConfiguration
import pytest


def _rehearse(*entities: Any) -> tuple[Record, int]:
    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription(entities))
    return rehearse(service)


def _text(*entities: Any) -> str:
    return '\n'.join(tree_lines(_rehearse(*entities)[0])) + '\n'


def test_nothing_is_started(tmp_path: Path, recwarn: pytest.WarningsRecorder) -> None:
    """No process, no coroutine, no reaction to an event; and no file is left."""
    seen: list[str] = []

    async def run(context: Any) -> None:
        seen.append('coroutine')

    def react(context: Any) -> None:
        seen.append('reaction')

    root, status = _rehearse(
        ExecuteProcess(cmd=['touch', str(tmp_path / 'made')]),
        OpaqueCoroutine(coroutine=run),
        TimerAction(period=0.0, actions=[OpaqueFunction(function=react)]),
        RegisterEventHandler(OnShutdown(on_shutdown=[OpaqueFunction(function=react)])),
        LogInfo(msg='x'),
    )
    assert (status, seen, os.listdir(tmp_path)) == (0, [], [])
    assert [each.action for each in root.children][:2] == ['ExecuteProcess', 'OpaqueCoroutine']
    assert not [each for each in recwarn if 'never awaited' in str(each.message)]


def test_facts_of_a_process() -> None:
    """Words, folder and what is different in the environment are told."""
    os.environ['GONE'] = '1'
    process = ExecuteProcess(
        cmd=['ls', Command('echo -n a b')], cwd='/', env={'PATH': os.environ['PATH'], 'NEW': 'x'}
    )
    facts = _rehearse(process)[0].children[0].facts
    assert (facts['argv'], facts['cwd']) == (['ls', 'a b'], '/')
    assert facts['environment']['NEW'] == 'x' and facts['environment']['GONE'] is None
    assert 'PATH' not in facts['environment']


def test_environment_set_by_the_launch() -> None:
    """What actions set is a change against the launcher's own environment."""
    root, _ = _rehearse(SetEnvironmentVariable('NEW', 'x'), ExecuteProcess(cmd=['ls']))
    assert root.children[1].facts['environment'] == {'NEW': 'x'}


def test_text() -> None:
    """The tree shows scopes, conditions with their reason, and what waits for which event."""
    process = ExecuteProcess(cmd=['ls', 'a b'], name='it', on_exit=[LogInfo(msg='over')])
    text = _text(
        DeclareLaunchArgument('sim', default_value='False'),
        GroupAction([LogInfo(msg='in')], condition=IfCondition(LaunchConfiguration('sim'))),
        GroupAction([LogInfo(msg='out')], scoped=False),
        process,
        TimerAction(period=2.0, actions=[LogInfo(msg=LaunchConfiguration('sim'))]),
        RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[LogInfo(msg='x')])),
    )
    lines = [line.partition('  (test_')[0] for line in text.splitlines()]
    label = process.name
    assert lines == [
        "DeclareLaunchArgument sim = 'False' (the default)",
        'GroupAction',
        "  if IfCondition(LaunchConfig('sim')), which expanded to 'false': false, so it",
        '      is skipped',
        'GroupAction',
        '  scoped: False',
        '  LogInfo out',
        f'ExecuteProcess {label}',
        "  argv: ls 'a b'",
        '  waiting for its end:',
        "    LogInfo 'over'",
        'TimerAction',
        '  waiting for 2.0 s to pass:',
        "    LogInfo LaunchConfig('sim')",
        'RegisterEventHandler',
        f"  waiting for ProcessExited of '{label}':",
        "    LogInfo 'x'",
    ]
    assert all(len(line) <= 80 for line in lines)


def test_failure(capfd: pytest.CaptureFixture[str]) -> None:
    """The error and the status are those of a real run."""
    root, status = _rehearse(ExecuteProcess(cmd=['no_such_program']))
    assert status == 1
    assert root.as_data()['error'].startswith("the program 'no_such_program' was not found")
    assert "the program 'no_such_program' was not found" in capfd.readouterr().out


def test_reactions_and_events() -> None:
    """A handler that calls a function is told, too; an event that is emitted later has a name."""
    process = ExecuteProcess(cmd=['ls'], name='it')
    emit = EmitEvent(event=Shutdown(reason='over'))
    text = _text(
        process,
        RegisterEventHandler(OnProcessIO(target_action=process, on_stdout=lambda event: None)),
        RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[emit])),
    )
    assert f"  waiting for ProcessIO of '{process.name}'; what follows is not known yet\n" in text
    assert '    EmitEvent Shutdown' in text


def test_data() -> None:
    """As data each action has its place, its condition and what lies below it."""
    process = ExecuteProcess(cmd=['ls'], shell=True, condition=IfCondition('true'))
    data = json.loads(json.dumps(_rehearse(GroupAction([process]))[0].as_data()))
    group = data['actions'][0]
    assert (group['action'], group['scoped'], group['file']) == ('GroupAction', True, __file__)
    found = group['actions'][0]
    assert found['condition'] == {
        'expression': "IfCondition('true')",
        'expanded': 'true',
        'value': True,
    }
    assert (found['argv'], found['shell'], found['environment']) == (['ls'], True, {})


def test_introspector(tmp_path: Path) -> None:
    """A description is shown as a tree without running it, also one that includes itself."""
    path = tmp_path / 'x.launch.py'
    path.write_text(
        'from launch import LaunchDescription\nfrom launch.actions import *\n'
        'def generate_launch_description():\n'
        f'    return LaunchDescription([IncludeLaunchDescription("{path}")])\n'
    )
    description = LaunchDescription([LogInfo(msg='x'), IncludeLaunchDescription(str(path))])
    lines = LaunchIntrospector().format_launch_description(description).splitlines()
    assert lines[1] == "    LogInfo(text='x')"
    assert lines[2].startswith('    IncludeLaunchDescription(')
    assert lines[-1].strip() == '(a file that includes itself)'
