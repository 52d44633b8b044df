# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.2: launch configurations, their scopes, and the context."""

from __future__ import annotations

import os
from typing import Any

import pytest

SHOW = """
def show(context):
    print('=', *(f'{name}={value}' for name, value in context.launch_configurations.items()
                 if name in 'abcde'), flush=True)
---
"""


def _shown(out: Any) -> list[str]:
    """Return the configurations at each place of OpaqueFunction(function=show)."""
    return [line[2:] for line in out.lines if line.startswith('=')]


def test_configuration_is_looked_up_when_performed(launch: Any) -> None:
    """3.2 Names and defaults may be lists; defaults that are no text become one, part by part."""
    out = launch(
        """
        SetLaunchConfiguration('name', 'a'),
        SetLaunchConfiguration(['x', LaunchConfiguration('name')],
                               ['1', LaunchConfiguration('name')]),
        LogInfo(msg=LaunchConfiguration(['x', LaunchConfiguration('name')])),
        LogInfo(msg=LaunchConfiguration('no', default=['d', LaunchConfiguration('name')])),
        LogInfo(msg=LaunchConfiguration('no', default=False)),
        LogInfo(msg=LaunchConfiguration('no', default=1.5)),
        LogInfo(msg=LaunchConfiguration('no', default=[1, 'b', True])),
        LogInfo(msg=LaunchConfiguration('no', default='')),
        SetLaunchConfiguration('xa', 'again'),
        LogInfo(msg=LaunchConfiguration('xa')),
        SetLaunchConfiguration('odd name!', 'ok'),
        LogInfo(msg=LaunchConfiguration('odd name!')),
        """
    )
    assert out.status == 0
    assert out.said == ['1a', 'da', 'False', '1.5', '1bTrue', '', 'again', 'ok']


def test_missing_configuration(launch: Any) -> None:
    """3.2 One that does not exist and has no default is an error; unset is as never set."""
    out = launch(
        """
        UnsetLaunchConfiguration('never'),
        SetLaunchConfiguration('a', '1'),
        UnsetLaunchConfiguration('a'),
        LogInfo(msg=LaunchConfiguration('a')),
        """
    )
    assert out.status == 1
    assert out.error.startswith("launch configuration 'a' does not exist")


CHILD = """
    DeclareLaunchArgument('a', default_value='child a'),
    DeclareLaunchArgument('b', default_value='child b'),
    SetLaunchConfiguration('c', 'child c'),
"""


def test_include_is_no_scope(launch: Any) -> None:
    """3.2 What an include is given, declares and sets stays, and a later include finds it set."""
    out = launch(
        SHOW
        + """
        IncludeLaunchDescription('child.launch.py', launch_arguments={'a': 'given'}.items()),
        OpaqueFunction(function=show),
        SetLaunchConfiguration('b', 'mine'),
        IncludeLaunchDescription('child.launch.py'),
        OpaqueFunction(function=show),
        """,
        files={'child.launch.py': CHILD},
    )
    assert _shown(out) == ['a=given b=child b c=child c', 'a=given b=mine c=child c']


def test_arguments_of_an_include_are_set_in_order(launch: Any) -> None:
    """3.2 A later argument of an include sees the value of an earlier one."""
    out = launch(
        SHOW
        + """
        IncludeLaunchDescription('child.launch.py', launch_arguments=[
            ('a', '1'), ('b', [LaunchConfiguration('a'), '2']), ('d', LaunchConfiguration('b'))]),
        OpaqueFunction(function=show),
        """,
        files={'child.launch.py': CHILD},
    )
    assert _shown(out) == ['a=1 b=12 d=12 c=child c']


def test_scoped_group(launch: Any) -> None:
    """3.2 A group restores configurations and environment; its own ones hold inside."""
    out = launch(
        SHOW
        + """
        SetLaunchConfiguration('a', '1'),
        SetEnvironmentVariable('CASE_ENV', 'outer'),
        GroupAction([
            OpaqueFunction(function=show),
            SetLaunchConfiguration('a', '2'),
            SetLaunchConfiguration('c', '3'),
            SetEnvironmentVariable('CASE_ENV', 'inner'),
            ExecuteProcess(cmd=['rec', 'in']),
        ], launch_configurations={'b': [LaunchConfiguration('a'), 'b']}),
        OpaqueFunction(function=show),
        ExecuteProcess(cmd=['rec', 'out']),
        """
    )
    assert _shown(out) == ['a=1 b=1b', 'a=1']
    assert {run.args[0]: run.env['CASE_ENV'] for run in out.runs} == {
        'in': 'inner',
        'out': 'outer',
    }


def test_group_without_forwarding(launch: Any) -> None:
    """3.2 Without forwarding only what is passed on gets in, with the first environment."""
    out = launch(
        SHOW
        + """
        SetLaunchConfiguration('a', '1'),
        SetLaunchConfiguration('b', '2'),
        SetEnvironmentVariable('CASE_ENV', 'set'),
        GroupAction([
            OpaqueFunction(function=show),
            LogInfo(msg=EnvironmentVariable('CASE_ENV', default_value='unset')),
        ], forwarding=False, launch_configurations={'c': LaunchConfiguration('a')}),
        OpaqueFunction(function=show),
        LogInfo(msg=EnvironmentVariable('CASE_ENV')),
        """
    )
    assert _shown(out) == ['c=1', 'a=1 b=2']
    assert out.said == ['unset', 'set']


def test_group_that_is_no_scope(launch: Any) -> None:
    """3.2 With scoped=False everything stays, also the given configurations."""
    out = launch(
        SHOW
        + """
        GroupAction([SetLaunchConfiguration('b', '2'), SetEnvironmentVariable('CASE_ENV', 'kept')],
                    scoped=False, launch_configurations={'a': '1'}),
        OpaqueFunction(function=show),
        LogInfo(msg=EnvironmentVariable('CASE_ENV')),
        """
    )
    assert (_shown(out), out.said) == (['a=1 b=2'], ['kept'])


def test_group_with_a_false_condition(launch: Any) -> None:
    """3.2 A false condition of a group leaves everything as it is."""
    out = launch(
        SHOW
        + """
        GroupAction([SetLaunchConfiguration('b', '2')], scoped=False,
                    launch_configurations={'a': '1'}, condition=IfCondition('0')),
        GroupAction([LogInfo(msg=LaunchConfiguration('no'))], condition=UnlessCondition('1')),
        OpaqueFunction(function=show),
        """
    )
    assert (out.status, _shown(out), out.said) == (0, [''], [])


def test_event_handlers_see_the_configurations_of_later(launch: Any) -> None:
    """3.2 A scope has ended when an event of it is handled."""
    out = launch(
        """
        SetLaunchConfiguration('a', 'outer'),
        GroupAction([
            SetLaunchConfiguration('a', 'inner'),
            ExecuteProcess(cmd=['true'], on_exit=[LogInfo(msg=LaunchConfiguration('a'))]),
        ]),
        SetLaunchConfiguration('a', 'later'),
        """
    )
    assert out.said == ['later']
    out = launch(
        """
        GroupAction([
            SetLaunchConfiguration('b', 'inner'),
            ExecuteProcess(cmd=['true'], on_exit=[LogInfo(msg=LaunchConfiguration('b'))]),
        ]),
        """
    )
    assert out.status == 1
    assert out.error.startswith("launch configuration 'b' does not exist")


def test_timers_keep_the_configurations_of_their_start(launch: Any) -> None:
    """3.2 A timer's actions see those of its start (3.0), and change nothing outside."""
    out = launch(
        """
        from launch_ros.substitutions import Parameter as Given
        ---
        GroupAction([
            SetLaunchConfiguration('a', 'inner'),
            SetParameter('listed', 1),
            TimerAction(period=0.1, actions=[
                LogInfo(msg=LaunchConfiguration('a')),
                LogInfo(msg=Given('listed')),
                SetLaunchConfiguration('a', 'by the timer'),
                LogInfo(msg=LaunchConfiguration('a')),
            ]),
        ]),
        SetLaunchConfiguration('a', 'later'),
        RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg=LaunchConfiguration('a'))])),
        """
    )
    assert out.said == ['inner', '1', 'by the timer', 'later']


def test_actions_of_scopes(launch: Any) -> None:
    """3.2 Scopes can be pushed, popped and reset by actions of their own."""
    out = launch(
        SHOW
        + """
        SetLaunchConfiguration('a', '1'),
        SetLaunchConfiguration('b', '2'),
        PushLaunchConfigurations(),
        SetLaunchConfiguration('a', 'pushed'),
        ResetLaunchConfigurations({'c': LaunchConfiguration('a')}),
        OpaqueFunction(function=show),
        ResetLaunchConfigurations(),
        OpaqueFunction(function=show),
        PopLaunchConfigurations(),
        OpaqueFunction(function=show),
        SetEnvironmentVariable('CASE_ENV', '1'),
        PushEnvironment(),
        SetEnvironmentVariable('CASE_ENV', '2'),
        LogInfo(msg=EnvironmentVariable('CASE_ENV', default_value='none')),
        ResetEnvironment(),
        LogInfo(msg=EnvironmentVariable('CASE_ENV', default_value='none')),
        PopEnvironment(),
        LogInfo(msg=EnvironmentVariable('CASE_ENV', default_value='none')),
        """
    )
    assert _shown(out) == ['c=pushed', '', 'a=1 b=2']
    assert out.said == ['2', 'none', '1']


@pytest.mark.parametrize('action', ['PopLaunchConfigurations()', 'PopEnvironment()'])
def test_pop_without_push(action: str, launch: Any) -> None:
    """3.2 To pop what was not pushed is an error."""
    out = launch(f'{action},')
    assert (out.status, 'Caught exception in launch' in out.text) == (1, True)


def test_magic_names_work_on_any_file(launch: Any) -> None:
    """3.2 Magic names can be set from the command line for any launch file."""
    out = launch(
        "Node(package='stub', executable='rec', output='screen'),",
        'ros_namespace:=/robot',
        'launch-prefix:=env CASE_PREFIX=1',
        'launch-prefix-filter:=re',
        'emulate_tty:=true',
        REC_THEN='[ -t 1 ] && echo on a terminal',
    )
    assert out.run.args == ['--ros-args', '-r', '__ns:=/robot']
    assert out.run.env['CASE_PREFIX'] == '1'
    assert '[env-1] on a terminal' in out.lines


def test_context_of_a_launch(launch: Any) -> None:
    """3.2 The context gives a launch file its configurations, environment, words and locals."""
    out = launch(
        """
        import os
        from launch.substitutions import TextSubstitution

        def look(context):
            print(context.launch_configurations['word'])
            context.launch_configurations['made'] = 'by hand'
            print(context.environment is os.environ)
            os.environ['CASE_ENV'] = 'by os.environ'
            context.environment['CASE_ENV2'] = 'by the context'
            print(context.perform_substitution(TextSubstitution(text='text')))
            print('argv', context.argv, context.noninteractive, context.is_shutdown)
            print(context.asyncio_loop.is_running())
            context.extend_locals({'mine': '1'})
            context.extend_globals({'ours': '2'})
            print(context.locals.mine, context.locals.ours)
            print(context.get_locals_as_dict()['mine'])
            try:
                context.locals.nowhere
            except AttributeError as error:
                print('mine' in str(error))
            try:
                context.locals.mine = '3'
            except AttributeError:
                print('read-only')
            try:
                context.unregister_event_handler(OnShutdown(on_shutdown=[]))
            except ValueError:
                print('not registered', flush=True)
        ---
        DeclareLaunchArgument('word'),
        OpaqueFunction(function=look),
        LogInfo(msg=LaunchConfiguration('made')),
        LogInfo(msg=Command('printenv CASE_ENV CASE_ENV2')),
        RegisterEventHandler(OnShutdown(on_shutdown=[
            LogInfo(msg=LocalSubstitution('ours')),
            LogInfo(msg=LocalSubstitution('mine'))])),
        """,
        'word:=w',
    )
    printed = [line for line in out.lines if not line.startswith('[')][:11]
    assert printed == [
        *['w', 'True', 'text', "argv ['word:=w'] True False", 'True', '1 2', '1', 'True'],
        *['read-only', 'not registered', 'by the context'],
    ]
    assert out.said[:1] == ['by hand']
    assert 'by os.environ' in out.text
    assert (out.status, out.said[2]) == (1, '2')


def test_completion_futures(launch: Any) -> None:
    """3.2 The launch waits for futures that were added to it; emitting can be awaited."""
    out = launch(
        """
        import launch.events


        def slow(context):
            future = context.asyncio_loop.create_future()
            context.asyncio_loop.call_later(0.3, lambda: print('done') or future.set_result(None))
            context.add_completion_future(future)


        async def emit(context):
            await context.emit_event(launch.events.TimerEvent(timer_action=None))
        ---
        RegisterEventHandler(EventHandler(
            matcher=lambda event: isinstance(event, launch.events.TimerEvent),
            entities=[LogInfo(msg='event')])),
        OpaqueFunction(function=slow),
        OpaqueCoroutine(coroutine=emit),
        """
    )
    assert (out.status, out.said) == (0, ['event'])
    assert 'done' in out.lines


def test_a_context_without_a_launch(launch: Any) -> None:
    """3.2 A context can be made anywhere to perform substitutions and hold handlers."""
    out = launch.script(
        """
        context = LaunchContext()
        context.launch_configurations['a'] = '1'
        print(LaunchConfiguration('a').perform(context), context.asyncio_loop, context.argv)
        event = Event()
        first = EventHandler(matcher=lambda event: True)
        print(context.would_handle_event(event))
        context.register_event_handler(first)
        print(context.would_handle_event(event))
        context.unregister_event_handler(first)
        print(context.would_handle_event(event))
        context.emit_event_sync(event)
        """
    )
    assert out.stdout.splitlines() == ['1 None []', 'False', 'True', 'False']
    assert out.err == ''


def test_handlers_can_be_appended(launch: Any) -> None:
    """3.2 A handler comes before the others unless it is appended."""
    out = launch(
        """
        def handler(text):
            return OnShutdown(on_shutdown=[LogInfo(msg=text)])


        def register(context):
            context.register_event_handler(handler('last'), append=True)
            context.register_event_handler(handler('first'))
        ---
        RegisterEventHandler(handler('middle')),
        OpaqueFunction(function=register),
        """
    )
    assert out.said == ['first', 'middle', 'last']


def test_environment_of_the_launch_is_inherited(launch: Any) -> None:
    """3.2 The environment is that of the launch itself."""
    out = launch("ExecuteProcess(cmd=['rec']),", CASE_ENV='from outside')
    assert out.run.env['CASE_ENV'] == 'from outside'
    assert out.run.env['HOME'] == os.environ['HOME']
