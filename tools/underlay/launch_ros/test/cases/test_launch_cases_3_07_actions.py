# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.7: plain actions."""

from __future__ import annotations

from typing import Any

ACTIONS = [
    "LogInfo(msg='a'{})",
    "SetEnvironmentVariable('A', 'a'{})",
    "UnsetEnvironmentVariable('A'{})",
    "AppendEnvironmentVariable('A', 'a'{})",
    "SetLaunchConfiguration('a', 'a'{})",
    "UnsetLaunchConfiguration('a'{})",
    "DeclareLaunchArgument('a', default_value=''{})",
    'OpaqueFunction(function=print{})',
    'EmitEvent(event=Event(){})',
    "Shutdown(reason='a'{})",
    'RegisterEventHandler(OnShutdown(on_shutdown=[]){})',
    'TimerAction(period=1.0, actions=[]{})',
    'GroupAction([]{})',
    "IncludeLaunchDescription('none'{})",
    "ExecuteProcess(cmd=['rec']{})",
    "Node(executable='rec'{})",
    'PushLaunchConfigurations({})',
    "SetParameter('a', 1{})",
    "SetRemap('a', 'b'{})",
    "PushRosNamespace('a'{})",
]


def test_every_action_takes_a_condition(launch: Any) -> None:
    """3.7 Any action can have a condition, and takes no keyword that it does not know."""
    out = launch.script(
        """
        never = 'condition=IfCondition("0")'
        entities = []
        for text in ACTIONS:
            comma = '' if '({}' in text else ', '
            entities.append(eval(text.format(comma + never)))
            try:
                eval(text.format(comma + 'bogus=1'))
                print('accepted', text)
            except TypeError as error:
                pass
        service = LaunchService()
        service.include_launch_description(LaunchDescription(entities))
        print('status', service.run(), flush=True)
        """.replace('ACTIONS', repr(ACTIONS))
    )
    assert out.lines == ['status 0']
    assert (out.runs, out.err) == ([], '')


def test_log_info(launch: Any) -> None:
    """3.7 LogInfo writes at the level INFO, on the screen and in the file."""
    out = launch("LogInfo(msg=['a', TextSubstitution(text=' %s b')]),")
    assert out.lines == ['[INFO] [launch.user]: a %s b']
    assert out.log[2:] == ['[INFO] [launch.user]: a %s b']


def test_environment_variables(launch: Any) -> None:
    """3.7 Variables are set, unset, and lengthened at either end."""
    out = launch(
        """
        SetEnvironmentVariable('CASE_SET', ['v', TextSubstitution(text='1')]),
        SetEnvironmentVariable(name='CASE_GONE', value='v'),
        UnsetEnvironmentVariable('CASE_GONE'),
        UnsetEnvironmentVariable('CASE_NEVER'),
        AppendEnvironmentVariable('CASE_NEW', 'only'),
        AppendEnvironmentVariable('CASE_PATH', 'end'),
        AppendEnvironmentVariable('CASE_PATH', 'begin', prepend=True),
        AppendEnvironmentVariable('CASE_LIST', 'b', separator=', '),
        AppendEnvironmentVariable('CASE_LIST', '0', prepend='yes', separator=[',', ' ']),
        ExecuteProcess(cmd=['rec']),
        """,
        CASE_PATH='mid',
        CASE_LIST='a',
        CASE_OUTSIDE='1',
    )
    env = {name: value for name, value in out.run.env.items() if name.startswith('CASE_')}
    assert env == {
        'CASE_SET': 'v1',
        'CASE_NEW': 'only',
        'CASE_PATH': 'begin:mid:end',
        'CASE_LIST': '0, a, b',
        'CASE_OUTSIDE': '1',
    }


def test_opaque_functions(launch: Any) -> None:
    """3.7 A function gets the context and its arguments; what it returns is visited in place."""
    out = launch(
        """
        def function(context, *args, **kwargs):
            return [LogInfo(msg=f'{args} {kwargs} {type(context).__name__}'),
                    LogInfo(msg='second')]
        ---
        LogInfo(msg='before'),
        OpaqueFunction(function=function, args=[1, 'a'], kwargs={'k': 2}),
        OpaqueFunction(function=lambda context: None),
        OpaqueFunction(function=lambda context: (LogInfo(msg=text) for text in 'xy')),
        LogInfo(msg='behind'),
        """
    )
    assert out.said == [
        *['before', "(1, 'a') {'k': 2} LaunchContext", 'second', 'x', 'y', 'behind']
    ]


def test_opaque_coroutines(launch: Any) -> None:
    """3.7 A coroutine runs beside, keeps the launch alive, and is cancelled on shutdown."""
    out = launch(
        """
        import asyncio

        async def first(context, text, *, more):
            await asyncio.sleep(0.1)
            print(text, more, flush=True)

        async def second():
            await asyncio.sleep(0.2)
            print('second', flush=True)

        async def third(context):
            try:
                await asyncio.sleep(60)
            except asyncio.CancelledError:
                print('cancelled', flush=True)
                raise
        ---
        OpaqueCoroutine(coroutine=first, args=['first'], kwargs={'more': 'arguments'}),
        OpaqueCoroutine(coroutine=second, ignore_context=True),
        OpaqueCoroutine(coroutine=third),
        TimerAction(period=0.6, actions=[Shutdown()]),
        LogInfo(msg='walked'),
        """
    )
    assert out.lines == [
        *['[INFO] [launch.user]: walked', 'first arguments', 'second', 'cancelled']
    ]
    assert out.status == 0


def test_shutdown(launch: Any) -> None:
    """3.7 A shutdown is an event of its own: what is behind it is visited, and started."""
    out = launch(
        """
        RegisterEventHandler(OnShutdown(on_shutdown=[
            LogInfo(msg=['reason: ', LocalSubstitution('event.reason')])])),
        Shutdown(),
        Shutdown(reason=['be', 'cause']),
        LogInfo(msg='behind'),
        ExecuteProcess(cmd=['sleep', '60']),
        """
    )
    assert out.status == 0
    assert out.said == ['behind', 'reason: reason not given', 'reason: because']
    assert '[INFO] [sleep-1]: process started with pid [N]' in out.lines
    assert "[INFO] [sleep-1]: sending signal 'SIGINT' to process[sleep-1]" in out.lines
    assert any('exit code -2' in line for line in out.lines)


def test_required_process(launch: Any) -> None:
    """3.7 A shutdown because of a process that has ended says which."""
    out = launch(
        """
        ExecuteProcess(cmd=['sh', '-c', 'exit 1'], name='vital', on_exit=Shutdown(reason='gone')),
        ExecuteProcess(cmd=['sleep', '60']),
        """
    )
    line = '[INFO] [launch]: process[vital-1] was required: shutting down launched system'
    assert line in out.lines
    assert out.status == 0


def test_handlers_are_registered_when_visited(launch: Any) -> None:
    """3.7 Registering and unregistering a handler take effect when they are visited."""
    out = launch(
        """
        class Mine(Event):
            pass

        def handler(text):
            return EventHandler(matcher=lambda event: isinstance(event, Mine),
                                entities=[LogInfo(msg=text)])
        gone = handler('gone')
        ---
        RegisterEventHandler(gone),
        RegisterEventHandler(handler('stays')),
        RegisterEventHandler(handler('never'), condition=IfCondition('0')),
        EmitEvent(event=Mine()),
        UnregisterEventHandler(gone),
        """
    )
    assert out.said == ['stays']


def test_timers(launch: Any) -> None:
    """3.7 A timer fires once, keeps the launch alive, and ends silently with it."""
    out = launch(
        """
        early = TimerAction(period=0.1, actions=[LogInfo(msg='cancelled before')])
        late = TimerAction(period=60.0, actions=[LogInfo(msg='cancelled behind')])
        early.cancel()

        def stop(context):
            late.cancel()
        ---
        early,
        late,
        TimerAction(period=LaunchConfiguration('p', default='0.3'), actions=[
            LogInfo(msg='second'), OpaqueFunction(function=stop), Shutdown()]),
        TimerAction(period='0.1', actions=[LogInfo(msg='first')]),
        TimerAction(period=61.0, actions=[LogInfo(msg='never')]),
        TimerAction(period=0.5, actions=[LogInfo(msg='kept')], cancel_on_shutdown=False),
        """
    )
    assert out.status == 0
    assert out.said == ['first', 'second', 'kept']
    assert [line for line in out.lines if '[launch.user]' not in line] == []
    assert 'UserWarning' in out.err


def test_period_of_a_timer(launch: Any) -> None:
    """3.7 A period that is an int is an error."""
    out = launch('TimerAction(period=1, actions=[]),')
    assert out.status == 1
    assert ' - TypeError: ' in out.error


def test_descriptions(launch: Any) -> None:
    """3.7 A description copies what it is given and can be added to."""
    out = launch(
        """
        def generate_launch_description():
            entities = [LogInfo(msg='a'), DeclareLaunchArgument('x', default_value='1')]
            it = LaunchDescription(entities)
            entities.clear()
            it.add_action(LogInfo(msg='b'))
            it.add_entity(LaunchDescription([LogInfo(msg='c')]))
            print(len(it.entities), [each.name for each in it.get_launch_arguments()],
                  len(it.describe_sub_entities()), LaunchDescription().entities, flush=True)
            return it
        """
    )
    assert (out.status, out.said) == (0, ['a', 'b', 'c'])
    assert "4 ['x'] 4 []" in out.lines


def test_deprecated_descriptions(launch: Any) -> None:
    """3.7 A description that is deprecated says so when it is visited."""
    out = launch(
        """
        def generate_launch_description():
            return LaunchDescription([LogInfo(msg='a')], deprecated_reason='old')
        """
    )
    assert out.lines == [
        '[WARNING] [root]: launch file [HERE/it.launch.py] is deprecated: old',
        '[INFO] [launch.user]: a',
    ]
