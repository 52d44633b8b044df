# SPDX-License-Identifier: Apache-2.0
"""Events, their handlers, and the actions that have to do with them."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from launch import Event, EventHandler, LaunchContext
from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    LogInfo,
    OpaqueCoroutine,
    OpaqueFunction,
    RegisterEventHandler,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
    UnregisterEventHandler,
)
from launch.event_handlers import (
    event_named,
    OnExecutionComplete,
    OnProcessExit,
    OnProcessIO,
    OnProcessStart,
    OnShutdown,
)
from launch.substitutions import LaunchConfiguration, LocalSubstitution
import pytest

Run = Callable[..., Any]


class Ping(Event):
    """An event of these tests."""

    name = 'test.Ping'


def _is_ping(event: Event) -> bool:
    return isinstance(event, Ping)


def _texts(result: Any) -> list[str]:
    return [line.partition(']: ')[2] for line in result.lines]


def test_walk_comes_before_events(run: Run) -> None:
    """An event is handled when all that is being visited is done; the newest handler first."""
    result = run(
        RegisterEventHandler(EventHandler(matcher=_is_ping, entities=LogInfo(msg='older'))),
        RegisterEventHandler(
            EventHandler(matcher=event_named('test.Ping'), entities=[LogInfo(msg='newer')])
        ),
        EmitEvent(event=Ping()),
        LogInfo(msg='walk'),
    )
    assert _texts(result) == ['walk', 'newer', 'older']


def test_handler_registered_by_a_handler(run: Run) -> None:
    """A handler is not offered the event that made it, but the next one."""
    late = RegisterEventHandler(EventHandler(matcher=_is_ping, entities=[LogInfo(msg='late')]))
    first = EventHandler(matcher=_is_ping, entities=[late, LogInfo(msg='first')], handle_once=True)
    result = run(RegisterEventHandler(first), EmitEvent(event=Ping()), EmitEvent(event=Ping()))
    assert _texts(result) == ['first', 'late']


def test_entities_may_come_from_a_generator(run: Run) -> None:
    """They are looked at before they are visited, and visited at each event."""
    handler = EventHandler(matcher=_is_ping, entities=(LogInfo(msg=each) for each in 'ab'))
    result = run(RegisterEventHandler(handler), EmitEvent(event=Ping()), EmitEvent(event=Ping()))
    assert _texts(result) == ['a', 'b', 'a', 'b']


def test_unregistered_handler(run: Run) -> None:
    """A handler that was removed is asked no more."""
    handler = EventHandler(matcher=_is_ping, entities=[LogInfo(msg='no')])
    result = run(
        RegisterEventHandler(handler), UnregisterEventHandler(handler), EmitEvent(event=Ping())
    )
    assert _texts(result) == []


def test_emit_something_else() -> None:
    """Only events can be emitted."""
    with pytest.raises(RuntimeError, match='expected an event'):
        EmitEvent(event='ping')  # type: ignore[arg-type]


def test_shutdown_of_an_idle_launch(run: Run) -> None:
    """A launch that has nothing left to do shuts down, too."""
    result = run(
        RegisterEventHandler(
            OnShutdown(on_shutdown=[LogInfo(msg=LocalSubstitution('event.reason'))])
        )
    )
    assert (result.status, _texts(result)) == (0, ['idle'])


def test_entities_behind_a_shutdown_are_visited(run: Run) -> None:
    """A shutdown is an event like others; each of two is delivered."""
    reasons: list[str] = []
    result = run(
        RegisterEventHandler(
            OnShutdown(on_shutdown=lambda event, context: reasons.append(event.reason))
        ),
        Shutdown(reason='a'),
        LogInfo(msg='behind'),
        Shutdown(reason='b'),
    )
    assert (_texts(result), reasons) == (['behind'], ['a', 'b'])


def test_nothing_is_started_during_the_shutdown(run: Run) -> None:
    """A process that is visited after the shutdown began is left out."""
    result = run(
        RegisterEventHandler(
            OnShutdown(on_shutdown=[ExecuteProcess(cmd=['true']), LogInfo(msg='bye')])
        )
    )
    assert _texts(result) == ['bye']


@pytest.mark.parametrize(
    'reaction', [lambda event, context: None, lambda event, context: [None], []]
)
def test_empty_reactions(run: Run, reaction: Any) -> None:
    """A reaction may be nothing at all."""
    assert run(RegisterEventHandler(OnShutdown(on_shutdown=reaction))).status == 0


def test_wrong_reactions(run: Run) -> None:
    """A reaction must consist of entities; a callable's is checked when it is there."""
    with pytest.raises(TypeError, match="OnShutdown to be given .* but got ''x''"):
        OnShutdown(on_shutdown=['x'])  # type: ignore[list-item]
    result = run(RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: ['x'])))
    assert result.status == 1 and "but got ''x''" in result.text


@pytest.mark.parametrize(
    'handler, argument',
    [
        (OnProcessExit, 'on_exit'),
        (OnProcessStart, 'on_start'),
        (OnExecutionComplete, 'on_completion'),
    ],
)
def test_wrong_targets(handler: Any, argument: str) -> None:
    """A target is an action or a callable."""
    with pytest.raises(TypeError, match='target_action'):
        handler(target_action='node', **{argument: []})


def test_io_reactions_must_be_callables() -> None:
    """The reactions to output get the event."""
    with pytest.raises(TypeError, match='callables'):
        OnProcessIO(on_stdout=[LogInfo(msg='x')])  # type: ignore[arg-type]


def test_execution_complete(run: Run) -> None:
    """A handler that is there before its target is told about the end of it."""
    target = LogInfo(msg='target')
    result = run(
        RegisterEventHandler(
            OnExecutionComplete(target_action=target, on_completion=[LogInfo(msg='done')])
        ),
        target,
    )
    assert _texts(result) == ['target', 'done']


def test_execution_complete_of_a_timer(run: Run) -> None:
    """An action that takes time is complete when its time is over."""
    timer = TimerAction(period=0.05, actions=[])
    result = run(
        RegisterEventHandler(
            OnExecutionComplete(target_action=timer, on_completion=[LogInfo(msg='done')])
        ),
        timer,
        LogInfo(msg='walk'),
    )
    assert _texts(result) == ['walk', 'done']


def test_timer_keeps_its_scope(run: Run) -> None:
    """The actions of a timer see the scope in which it was started, and do not change others."""
    x = LaunchConfiguration('x')
    result = run(
        SetLaunchConfiguration('x', 'outer'),
        GroupAction(
            [
                SetLaunchConfiguration('x', 'inner'),
                TimerAction(
                    period=0.01, actions=[LogInfo(msg=x), SetLaunchConfiguration('x', 'changed')]
                ),
            ]
        ),
        TimerAction(period=0.1, actions=[LogInfo(msg=x)]),
    )
    assert _texts(result) == ['inner', 'outer']


@pytest.mark.filterwarnings('ignore:the period of a TimerAction')
@pytest.mark.parametrize('period', ['0.01', LaunchConfiguration('p', default='0.01')])
def test_period_as_a_text(run: Run, period: Any) -> None:
    """The period may be a text or a substitution."""
    assert _texts(run(TimerAction(period=period, actions=[LogInfo(msg='tick')]))) == ['tick']


def test_whole_number_as_a_period() -> None:
    """A whole number is refused with what to write instead."""
    with pytest.raises(TypeError, match='write 2.0 instead'):
        TimerAction(period=2, actions=[])


def test_shutdown_cancels_timers(run: Run) -> None:
    """A launch does not wait for timers when it ends."""
    assert _texts(run(TimerAction(period=60.0, actions=[LogInfo(msg='no')]), Shutdown())) == []


def test_canceled_timer(run: Run) -> None:
    """A timer that was canceled before it is visited never starts."""
    timer = TimerAction(period=60.0, actions=[LogInfo(msg='no')])
    timer.cancel()
    assert _texts(run(timer)) == []


def test_opaque_function(run: Run) -> None:
    """A function gets the context and its arguments, and may return entities."""

    def function(context: LaunchContext, a: int, *, b: int) -> list[LogInfo]:
        assert context.launch_configurations['x'] == '1'
        return [LogInfo(msg=f'{a} {b}')]

    result = run(
        SetLaunchConfiguration('x', '1'),
        OpaqueFunction(function=function, args=[1], kwargs={'b': 2}),
    )
    assert _texts(result) == ['1 2']


@pytest.mark.parametrize(
    'returned, text',
    [
        (LogInfo(msg='x'), "'LogInfo' object is not iterable: the function '<lambda>'"),
        ([None], "'NoneType' object has no attribute 'visit'"),
    ],
)
def test_wrong_result_of_an_opaque_function(run: Run, returned: Any, text: str) -> None:
    """A function must return a list of entities, or nothing."""
    result = run(OpaqueFunction(function=lambda context: returned))
    assert result.status == 1 and text in result.text


def test_opaque_coroutine(run: Run) -> None:
    """The launch waits for a coroutine."""

    async def coroutine(context: LaunchContext, name: str) -> None:
        await asyncio.sleep(0.02)
        context.emit_event_sync(Ping())
        assert name == 'x'

    result = run(
        RegisterEventHandler(EventHandler(matcher=_is_ping, entities=LogInfo(msg='ping'))),
        OpaqueCoroutine(coroutine=coroutine, args=['x']),
    )
    assert (result.status, _texts(result)) == (0, ['ping'])


def test_shutdown_cancels_coroutines(run: Run) -> None:
    """A launch does not wait for coroutines when it ends."""

    async def forever() -> None:
        await asyncio.get_running_loop().create_future()

    assert run(OpaqueCoroutine(coroutine=forever, ignore_context=True), Shutdown()).status == 0


def test_failing_coroutine(run: Run) -> None:
    """An error of a coroutine ends the launch."""

    async def fail() -> None:
        raise RuntimeError('because')

    result = run(
        OpaqueCoroutine(coroutine=fail, ignore_context=True), TimerAction(period=60.0, actions=[])
    )
    assert result.status == 1 and 'because' in result.text
