# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.16: the launch service and looking into descriptions."""

from __future__ import annotations

from typing import Any


def test_service(launch: Any) -> None:
    """3.16 A service runs what it is given, and tells its context, loop and task meanwhile."""
    out = launch.script(
        """
        service = LaunchService(argv=['a:=1'], noninteractive=True)

        def look(context):
            print(context is service.context, context.argv, context.noninteractive)
            print(service.event_loop is context.asyncio_loop, service.task is not None)

        service.include_launch_description(LaunchDescription([OpaqueFunction(function=look)]))
        print('status', service.run(), service.task)
        """
    )
    assert out.stdout.splitlines()[2:] == ["True ['a:=1'] True", 'True True', 'status 0 None']
    assert out.err == ''


def test_descriptions_and_events_from_other_threads(launch: Any) -> None:
    """3.16 Other threads may include descriptions, emit events and shut the service down."""
    out = launch.script(
        """
        import threading
        import time

        class Mine(Event):
            pass

        service = LaunchService()
        service.include_launch_description(LaunchDescription([
            RegisterEventHandler(EventHandler(matcher=lambda event: isinstance(event, Mine),
                                              entities=[LogInfo(msg='event')])),
            RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context:
                                            LogInfo(msg=event.reason))),
        ]))

        def work():
            service.include_launch_description(LaunchDescription([LogInfo(msg='included')]))
            service.emit_event(Mine())
            service.shutdown()

        thread = threading.Timer(0.3, work)
        thread.start()
        print('status', service.run(shutdown_when_idle=False), flush=True)
        """
    )
    assert out.said[:2] == ['included', 'event']
    assert len(out.said) == 3
    assert out.lines[-1] == 'status 0'
    assert out.err == ''


def test_asynchronous_run(launch: Any) -> None:
    """3.16 A service can run in a loop of somebody else, and be shut down there."""
    out = launch.script(
        """
        import asyncio

        async def main():
            service = LaunchService()
            service.include_launch_description(LaunchDescription([
                ExecuteProcess(cmd=['sleep', '60']), LogInfo(msg='in')]))
            task = asyncio.create_task(service.run_async(shutdown_when_idle=False))
            await asyncio.sleep(0.3)
            future = service.shutdown()
            if future is not None:
                await future
            print('status', await task, flush=True)

        asyncio.run(main())
        """
    )
    assert out.said == ['in']
    assert out.lines[-1] == 'status 0'
    assert 'exit code -2' in out.text
    assert out.err == ''


def test_failure_and_repetition(launch: Any) -> None:
    """3.16 A failure makes the status 1; a service can run again; -d is debug=True."""
    out = launch.script(
        """
        service = LaunchService(debug=True)
        service.include_launch_description(LaunchDescription([
            LogInfo(msg=LaunchConfiguration('none'))]))
        print('status', service.run(), flush=True)
        service.include_launch_description(LaunchDescription([LogInfo(msg='again')]))
        print('status', service.run(), flush=True)
        """
    )
    assert [line for line in out.lines if line.startswith('status')] == ['status 1', 'status 0']
    assert 'Traceback' in out.stdout
    assert '[INFO] [launch.user]: again' in out.lines


def test_introspection(launch: Any) -> None:
    """3.16 A description can be printed as a tree."""
    out = launch.script(
        """
        from launch import LaunchIntrospector
        text = LaunchIntrospector().format_launch_description(LaunchDescription([
            LogInfo(msg='hello'), GroupAction([ExecuteProcess(cmd=['ls', '-l'])]),
            RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg='bye')]))]))
        print(text)
        """
    )
    assert out.err == ''
    for part in ('LaunchDescription', 'hello', 'ls', 'bye'):
        assert part in out.stdout


def test_printed_description(launch: Any) -> None:
    """3.16 The option -p prints the tree of a launch file and starts nothing."""
    launch.write('it.launch.py', "LogInfo(msg='hello'), ExecuteProcess(cmd=['rec']),")
    out = launch.run('launch', '-p', 'it.launch.py').end()
    assert (out.status, out.runs) == (0, [])
    assert 'hello' in out.stdout


def test_exported_types(launch: Any) -> None:
    """3.16 The types of arguments, the error of launch files, and Executable are public."""
    out = launch.script(
        """
        from launch import InvalidLaunchFileError, SomeEntitiesType, SomeSubstitutionsType
        from launch.descriptions import Executable
        from launch.some_entities_type import SomeEntitiesType_types_tuple
        from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
        from launch import SomeEntitiesType_types_tuple as same
        from launch import SomeSubstitutionsType_types_tuple as same_too
        print(isinstance('a', SomeSubstitutionsType_types_tuple),
              isinstance(LogInfo(msg='a'), SomeEntitiesType_types_tuple),
              issubclass(InvalidLaunchFileError, Exception), Executable(cmd=['a']).final_name)
        """
    )
    assert (out.stdout, out.err) == ('True True True None\n', '')
