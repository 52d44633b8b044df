# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.1: how a launch is executed."""

from __future__ import annotations

from typing import Any

import pytest


def test_tree_is_walked_before_any_process_starts(launch: Any) -> None:
    """3.1 The tree is visited depth-first in list order, and only then processes start."""
    out = launch(
        """
        LogInfo(msg='1'),
        ExecuteProcess(cmd=['rec', 'first']),
        GroupAction([LogInfo(msg='2'), GroupAction([LogInfo(msg='3')]), LogInfo(msg='4')]),
        IncludeLaunchDescription('child.launch.py'),
        OpaqueFunction(function=lambda context: [LogInfo(msg='6'), LogInfo(msg='7')]),
        ExecuteProcess(cmd=['rec', 'second']),
        LogInfo(msg='8'),
        """,
        files={'child.launch.py': "LogInfo(msg='5'),"},
    )
    assert out.said == list('12345678')
    started = [line for line in out.lines if 'process started' in line]
    assert out.lines[8:10] == started
    assert started == [f'[INFO] [rec-{n}]: process started with pid [N]' for n in (1, 2)]
    assert out.args == [['first'], ['second']]
    assert out.status == 0


def test_queued_events_wait_for_the_walk(launch: Any) -> None:
    """3.1 Events are handled one after the other, in their order, behind the whole walk."""
    out = launch(
        """
        class Mine(Event):
            def __init__(self, text):
                self.text = text
        ---
        RegisterEventHandler(EventHandler(
            matcher=lambda event: isinstance(event, Mine),
            entities=[LogInfo(msg=LocalSubstitution('event.text'))])),
        EmitEvent(event=Mine('a')),
        EmitEvent(event=Mine('b')),
        LogInfo(msg='walked'),
        """
    )
    assert out.said == ['walked', 'a', 'b']


def test_false_condition_contributes_nothing(launch: Any) -> None:
    """3.1 The condition is evaluated when the action is visited; a false one leaves it out."""
    out = launch(
        """
        SetLaunchConfiguration('go', 'false'),
        LogInfo(msg='no', condition=IfCondition(LaunchConfiguration('go'))),
        ExecuteProcess(cmd=['rec', 'no'], condition=IfCondition(LaunchConfiguration('go'))),
        SetLaunchConfiguration('go', 'true'),
        LogInfo(msg='yes', condition=IfCondition(LaunchConfiguration('go'))),
        SetLaunchConfiguration('go', 'neither'),
        """
    )
    assert (out.status, out.lines) == (0, ['[INFO] [launch.user]: yes'])
    assert out.runs == []


def test_command_and_environment_are_frozen_at_the_visit(launch: Any) -> None:
    """3.1 What is set behind a process action does not reach the process."""
    out = launch(
        """
        SetEnvironmentVariable('COLOUR', 'red'),
        SetLaunchConfiguration('x', 'early'),
        SetLaunchConfiguration('folder', 'sub'),
        ExecuteProcess(cmd=['rec', LaunchConfiguration('x')], cwd=LaunchConfiguration('folder')),
        SetEnvironmentVariable('COLOUR', 'blue'),
        SetLaunchConfiguration('x', 'late'),
        SetLaunchConfiguration('folder', '.'),
        """,
        files={'sub/file': ''},
    )
    assert out.run.args == ['early']
    assert out.run.env['COLOUR'] == 'red'
    assert out.run.cwd == str(out.here / 'sub')


def test_handlers_of_an_event_are_a_snapshot(launch: Any) -> None:
    """3.1 Handlers run one after the other; what each returns is visited at once."""
    out = launch(
        """
        class Mine(Event):
            pass


        def handler(entities):
            return EventHandler(matcher=lambda event: isinstance(event, Mine), entities=entities)
        ---
        RegisterEventHandler(handler([LogInfo(msg='older'), LogInfo(msg='older too')])),
        RegisterEventHandler(handler([
            LogInfo(msg='newer'),
            RegisterEventHandler(handler([LogInfo(msg='only for the next')])),
            GroupAction([LogInfo(msg='newer too')])])),
        EmitEvent(event=Mine()),
        """
    )
    assert out.said == ['newer', 'newer too', 'older', 'older too']


def test_idle_launch_shuts_down(launch: Any) -> None:
    """3.1 When nothing is pending the launch shuts down for the reason idle, and returns 0."""
    out = launch(
        """
        RegisterEventHandler(OnShutdown(on_shutdown=[
            LogInfo(msg=['why: ', LocalSubstitution('event.reason')])])),
        TimerAction(period=0.2, actions=[LogInfo(msg='timer')]),
        ExecuteProcess(cmd=['rec']),
        """
    )
    assert out.said == ['timer', 'why: idle']
    assert out.lines[-1] == '[INFO] [launch.user]: why: idle'
    assert (out.status, len(out.runs)) == (0, 1)


def test_failed_processes_do_not_matter(launch: Any) -> None:
    """3.1 The status is 0 even if all processes fail."""
    out = launch(
        """
        ExecuteProcess(cmd=['sh', '-c', 'exit 3']),
        ExecuteProcess(cmd=['sh', '-c', 'kill -9 $$']),
        """
    )
    assert out.status == 0
    assert sorted(line for line in out.lines if 'ERROR' in line) == [
        "[ERROR] [sh-1]: process has died [pid N, exit code 3, cmd 'sh -c exit 3'].",
        "[ERROR] [sh-2]: process has died [pid N, exit code -9, cmd 'sh -c kill -9 $$'].",
    ]


WITH_EXCEPTION = """
    def fail(context):
        raise ValueError('it went wrong')
    ---
    RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg=LocalSubstitution('event.reason'))])),
    RegisterEventHandler(OnProcessIO(on_stderr=lambda event: [
        OpaqueFunction(function=fail), LogInfo(msg='never')])),
    ExecuteProcess(cmd=['sh', '-c', 'trap "echo got INT; exit 0" INT; echo >&2; sleep 30 & wait'],
                   output='screen'),
"""


def test_exception_ends_the_launch(launch: Any) -> None:
    """3.1 An exception is one line, ends the processes by SIGINT, and makes the status 1."""
    out = launch(WITH_EXCEPTION)
    error = '[ERROR] [launch]: Caught exception in launch (see debug for traceback): it went wrong'
    assert out.status == 1
    assert len([line for line in out.lines if line.startswith(error)]) == 1
    assert '[sh-1] got INT' in out.lines
    assert 'never' not in out.text
    assert out.said[0].startswith('it went wrong')
    assert 'Traceback' not in out.stdout + out.err
    assert '[INFO] [sh-1]: process has finished cleanly [pid N]' in out.lines


def test_exception_with_its_traceback(launch: Any) -> None:
    """3.1 At the level DEBUG the traceback of an exception is shown too."""
    out = launch(WITH_EXCEPTION, '--debug')
    assert out.status == 1
    assert 'Traceback' in out.stdout
    assert 'ValueError: it went wrong' in out.stdout


def test_what_follows_an_exception_is_not_visited(launch: Any) -> None:
    """3.1 Entities behind the one that fails are never visited."""
    out = launch(
        """
        LogInfo(msg='before'),
        GroupAction([LogInfo(msg=LaunchConfiguration('nowhere')), LogInfo(msg='in the group')]),
        LogInfo(msg='behind'),
        ExecuteProcess(cmd=['rec']),
        """
    )
    assert (out.status, out.said, out.runs) == (1, ['before'], [])
    assert out.error.startswith("launch configuration 'nowhere' does not exist")


def test_run_needs_the_main_thread_and_runs_once_at_a_time(launch: Any) -> None:
    """3.1 A run in another thread, or a second one at the same time, is a RuntimeError."""
    out = launch.script(
        """
        import threading


        def attempt(function):
            try:
                function()
            except RuntimeError:
                print('refused', flush=True)

        service = LaunchService()
        thread = threading.Thread(target=attempt, args=[service.run])
        thread.start()
        thread.join()

        async def again(context):
            try:
                await service.run_async()
            except RuntimeError:
                print('refused too', flush=True)

        import asyncio
        service.include_launch_description(LaunchDescription([
            OpaqueFunction(function=lambda context: [OpaqueCoroutine(coroutine=again)])]))
        print('status', service.run(), flush=True)
        print('status', service.run(), flush=True)
        """
    )
    told = [line for line in out.stdout.splitlines() if not line.startswith('[')]
    assert told == ['refused', 'refused too', 'status 0', 'status 0']
    assert out.err == ''


def test_an_action_may_be_visited_twice(launch: Any) -> None:
    """3.1 One action may stand in two places if it starts no process."""
    out = launch("*[LogInfo(msg='twice')] * 2,\n*[SetLaunchConfiguration('a', 'b')] * 2,")
    assert (out.status, out.said) == (0, ['twice', 'twice'])


@pytest.mark.parametrize(
    'entities',
    [
        "*[ExecuteProcess(cmd=['sh', '-c', 'exit 1'])] * 2,",
        """
        again = ExecuteProcess(cmd=['true'])
        target = ExecuteProcess(cmd=['rec'], respawn=True, respawn_max_retries=2)
        ---
        RegisterEventHandler(OnProcessExit(target_action=target, on_exit=[again])),
        target,
        """,
    ],
)
def test_a_process_action_may_not_run_twice(entities: str, launch: Any) -> None:
    """3.1 A process action that is visited again, also by a handler, is an error that names it."""
    out = launch(entities)
    assert out.status == 1
    assert 'executed more than once' in out.error
    assert 'ExecuteProcess' in out.error
    assert ("'sh-1'" in out.error) or ("'true-2'" in out.error)


@pytest.mark.parametrize(
    ('entities', 'error'),
    [
        ("LogInfo(msg='a'), None,", "has no attribute '"),
        ("OpaqueFunction(function=lambda context: LogInfo(msg='a')),", 'not iterable'),
        ('OpaqueFunction(function=lambda context: [None]),', "has no attribute '"),
        ("[LogInfo(msg='nested')],", "has no attribute '"),
        ('def generate_launch_description():\n    return None\n', 'None'),
    ],
)
def test_what_is_no_entity_is_an_error(entities: str, error: str, launch: Any) -> None:
    """3.1 None, a nested list, or a single entity instead of a list ends the launch."""
    out = launch(entities)
    assert out.status == 1
    assert error in out.error
    assert 'nested' not in out.said


def test_a_description_may_stand_among_entities(launch: Any) -> None:
    """3.1 A LaunchDescription may be an element of another."""
    out = launch(
        "LaunchDescription([LogInfo(msg='in')]), LogInfo(msg='behind'),"
        'OpaqueFunction(function=lambda context: None),'
    )
    assert (out.status, out.said) == (0, ['in', 'behind'])


HANDLER = 'RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: {result})),'


@pytest.mark.parametrize(
    ('result', 'said'),
    [
        ("LogInfo(msg='one')", ['one']),
        ("(LogInfo(msg=text) for text in 'ab')", ['a', 'b']),
        ("[LogInfo(msg='a'), None, LogInfo(msg='b')]", ['a', 'b']),
        ('None', []),
    ],
)
def test_results_of_handlers(result: str, said: list[str], launch: Any) -> None:
    """3.1 A handler may give an entity, several, or None; None among several is left out."""
    out = launch(HANDLER.replace('{result}', result))
    assert (out.status, out.said) == (0, said)


@pytest.mark.parametrize('result', ['[1]', "'text'", '7'])
def test_other_results_of_handlers(result: str, launch: Any) -> None:
    """3.1 Anything else from a handler is an error."""
    out = launch(HANDLER.replace('{result}', result))
    assert out.status == 1
    assert 'Caught exception in launch' in out.text
