# SPDX-License-Identifier: Apache-2.0
"""The launch service."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
import signal
import threading
from typing import Any

from launch import LaunchDescription, LaunchService
from launch.actions import (
    ExecuteProcess,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    TimerAction,
)
from launch.event_handlers import OnShutdown
import pytest

Run = Callable[..., Any]


def _fail(context: Any) -> None:
    raise RuntimeError('because')


def test_first_lines(run: Run) -> None:
    """Each launch begins with where its log is."""
    lines = run(LogInfo(msg='x')).text.splitlines()
    assert lines[0].startswith('[INFO] [launch]: All log files can be found below /')
    assert lines[1:] == [
        '[INFO] [launch]: Default logging verbosity is set to INFO',
        '[INFO] [launch.user]: x',
    ]


def test_debug(run: Run) -> None:
    """With `debug` the traceback of an error is shown."""
    text = run(OpaqueFunction(function=_fail), debug=True).text
    assert 'verbosity is set to DEBUG' in text and 'Traceback' in text
    assert 'in _fail' in text


def test_failing_action(run: Run) -> None:
    """An error ends the launch with status 1; what follows is not visited, nothing started."""
    result = run(
        ExecuteProcess(cmd=['true']), OpaqueFunction(function=_fail), LogInfo(msg='behind')
    )
    assert result.status == 1
    assert result.lines[0] == (
        '[ERROR] [launch]: Caught exception in launch (see debug for traceback): because'
    )
    assert result.lines[1].startswith(f"[ERROR] [launch]: It comes from '{__file__}', line ")
    assert len(result.lines) == 2


def test_failing_shutdown_handler(run: Run) -> None:
    """Processes are ended even if a handler of the shutdown fails."""
    handler = OnShutdown(on_shutdown=lambda event, context: _fail(context))
    result = run(
        ExecuteProcess(cmd=['sleep', '60']),
        RegisterEventHandler(handler),
        TimerAction(period=0.1, actions=[OpaqueFunction(function=_fail)]),
    )
    assert result.status == 1
    assert 'exit code -2' in result.text


def test_failing_callback_of_the_loop(run: Run) -> None:
    """An error in a callback counts, too."""

    def plan(context: Any) -> None:
        context.asyncio_loop.call_soon(_fail, context)

    result = run(OpaqueFunction(function=plan), TimerAction(period=60.0, actions=[]))
    assert result.status == 1 and 'because' in result.text


def test_service_can_run_again(capfd: pytest.CaptureFixture[str]) -> None:
    """A service that has ended may get more to do."""
    service = LaunchService()
    for text in ('first', 'second'):
        service.include_launch_description(LaunchDescription([LogInfo(msg=text)]))
        assert service.run() == 0
        assert text in capfd.readouterr().out


def test_only_in_the_main_thread() -> None:
    """Elsewhere no signals arrive, and the service says so."""
    errors: list[BaseException] = []

    def run() -> None:
        try:
            LaunchService().run()
        except RuntimeError as error:
            errors.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    assert 'main thread' in str(errors[0])


def test_only_once_at_a_time() -> None:
    """A second run while the first goes on is an error."""

    async def twice() -> list[Any]:
        service = LaunchService()
        return list(
            await asyncio.gather(service.run_async(), service.run_async(), return_exceptions=True)
        )

    first, second = asyncio.run(twice())
    assert first == 0 and 'already running' in str(second)


def test_shutdown_from_another_thread(wait_until: Callable[..., None]) -> None:
    """A service that is told to stay when it is idle ends when it is asked to."""
    service = LaunchService()

    def end() -> None:
        wait_until(lambda: service.event_loop is not None)
        service.shutdown()

    thread = threading.Thread(target=end)
    thread.start()
    assert service.run(shutdown_when_idle=False) == 0
    thread.join()


def test_signal_handlers_are_restored(run: Run) -> None:
    """After a run, signals mean what they meant before."""
    watched = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
    before = [signal.getsignal(number) for number in watched]
    run(LogInfo(msg='x'))
    assert [signal.getsignal(number) for number in watched] == before


def test_context_knows_its_arguments() -> None:
    """The arguments of the service are those of its context."""
    context = LaunchService(argv=['a:=b'], noninteractive=True).context
    assert (context.argv, context.noninteractive, context.is_shutdown) == (['a:=b'], True, False)
