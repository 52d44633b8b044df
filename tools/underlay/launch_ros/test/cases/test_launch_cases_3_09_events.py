# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.9: events and their handlers."""

from __future__ import annotations

from typing import Any


def test_newest_handler_first(launch: Any) -> None:
    """3.9 The newest handler runs first, and a process's own on_exit behind later ones."""
    out = launch(
        """
        it = ExecuteProcess(cmd=['true'], on_exit=[LogInfo(msg='own')])
        ---
        RegisterEventHandler(OnProcessExit(target_action=it, on_exit=[LogInfo(msg='before')])),
        it,
        RegisterEventHandler(OnProcessExit(target_action=it, on_exit=[LogInfo(msg='behind')])),
        RegisterEventHandler(OnProcessExit(target_action=it, on_exit=[LogInfo(msg='last')])),
        """
    )
    assert out.said == ['last', 'behind', 'own', 'before']


def test_start_and_exit(launch: Any) -> None:
    """3.9 Handlers for start and exit take an action, a predicate or all; events have fields."""
    out = launch(
        """
        it = ExecuteProcess(cmd=['sh', '-c', 'exit 2'], name='it', additional_env={'CASE_A': '1'})
        other = ExecuteProcess(cmd=['true'])

        def fields(event, context):
            return LogInfo(msg=f'{event.action is it} {event.process_name} {event.cmd} '
                               f'{event.cwd} {event.env["CASE_A"]} {event.pid > 0} '
                               f'{getattr(event, "returncode", None)}')

        def is_other(action):
            return action is other
        ---
        RegisterEventHandler(OnProcessStart(target_action=it, on_start=fields)),
        RegisterEventHandler(OnProcessExit(target_action=it, on_exit=fields)),
        RegisterEventHandler(OnProcessExit(
            target_action=is_other, on_exit=[LogInfo(msg='other'), LogInfo(msg='too')])),
        RegisterEventHandler(OnProcessStart(
            on_start=lambda event, context: LogInfo(msg='any ' + event.process_name))),
        it, other,
        """
    )
    assert out.status == 0
    assert sorted(out.said) == [
        "True it-1 ['sh', '-c', 'exit 2'] None 1 True 2",
        "True it-1 ['sh', '-c', 'exit 2'] None 1 True None",
        *['any it-1', 'any true-2', 'other', 'too'],
    ]


def test_output(launch: Any) -> None:
    """3.9 A handler for output gets what was read, as bytes."""
    out = launch(
        """
        it = ExecuteProcess(cmd=['sh', '-c', r"printf 'a\\nb'; printf c >&2"])

        def show(event):
            return LogInfo(msg=f'{event.text!r} {event.from_stdout} {event.from_stderr} '
                               f'{event.from_stdin} {event.process_name}')
        ---
        RegisterEventHandler(OnProcessIO(target_action=it, on_stdout=show, on_stderr=show)),
        RegisterEventHandler(OnProcessIO(on_stdout=lambda event: None)),
        it,
        """
    )
    assert sorted(out.said) == [
        "b'a\\nb' True False False sh-1",
        "b'c' False True False sh-1",
    ]


def test_shutdown(launch: Any) -> None:
    """3.9 A handler for the shutdown knows the reason and whether it was Ctrl-C."""
    out = launch(
        """
        import launch.events
        ---
        RegisterEventHandler(OnShutdown(on_shutdown=LogInfo(msg='single'))),
        RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg='list')])),
        RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: [
            LogInfo(msg=f'{event.reason} {event.due_to_sigint} {context.is_shutdown}')])),
        EmitEvent(event=launch.events.Shutdown(reason='mine')),
        """
    )
    assert out.said == ['mine False True', 'list', 'single']


def test_completion(launch: Any) -> None:
    """3.9 The completion of an action is told if its handler was there when it was visited."""
    out = launch(
        """
        def on(action, text):
            return RegisterEventHandler(OnExecutionComplete(
                target_action=action, on_completion=[LogInfo(msg=text)]))
        log, late = LogInfo(msg='log'), LogInfo(msg='late')
        process = ExecuteProcess(cmd=['true'])
        timer = TimerAction(period=0.1, actions=[])
        ---
        on(log, 'log complete'), on(process, 'process complete'), on(timer, 'timer complete'),
        log, late, process, timer,
        on(late, 'never'),
        """
    )
    assert out.status == 0
    assert out.said[:3] == ['log', 'late', 'log complete']
    assert sorted(out.said[3:]) == ['process complete', 'timer complete']


def test_once(launch: Any) -> None:
    """3.9 With handle_once a handler is gone before it runs."""
    out = launch(
        """
        class Mine(Event):
            pass

        def mine(event):
            return isinstance(event, Mine)
        ---
        RegisterEventHandler(EventHandler(matcher=mine, handle_once=True, entities=[
            LogInfo(msg='once'), EmitEvent(event=Mine())])),
        RegisterEventHandler(OnProcessStart(handle_once=True, on_start=[LogInfo(msg='first')])),
        EmitEvent(event=Mine()),
        EmitEvent(event=Mine()),
        ExecuteProcess(cmd=['true']),
        ExecuteProcess(cmd=['true']),
        """
    )
    assert sorted(out.said) == ['first', 'once']


def test_wrong_types(launch: Any) -> None:
    """3.9 A target that is no process, or something else than entities, is a TypeError."""
    errors = launch.errors(
        "OnProcessExit(target_action='text', on_exit=[])",
        "OnProcessExit(target_action=LogInfo(msg='x'), on_exit=[])",
        "OnProcessExit(on_exit=['text'])",
        'OnProcessStart(on_start=5)',
        'OnShutdown(on_shutdown=[None])',
    )
    assert all(error.startswith('TypeError: ') for error in errors), errors


def test_empty_handlers(launch: Any) -> None:
    """3.9 An empty list for an event is nothing (section 6)."""
    out = launch(
        """
        RegisterEventHandler(OnProcessStart(on_start=[])),
        RegisterEventHandler(OnProcessExit(on_exit=[])),
        RegisterEventHandler(OnShutdown(on_shutdown=[])),
        ExecuteProcess(cmd=['true'], on_exit=[]),
        """
    )
    assert (out.status, 'ERROR' in out.text) == (0, False)


def test_events_for_processes(launch: Any) -> None:
    """3.9 A process can be shut down and signalled by events; matchers say which."""
    out = launch(
        """
        from launch.events import matches_action
        from launch.events.process import (matches_name, matches_pid, ShutdownProcess,
                                           SignalProcess)
        import signal
        waiting = ['sh', '-c', 'trap "echo usr1" USR1; echo up; while :; do sleep 0.05; done']
        a = ExecuteProcess(cmd=waiting, name='a', output='screen')
        b = ExecuteProcess(cmd=['sleep', '60'], name='b')
        c = ExecuteProcess(cmd=['sleep', '61'], name='c')

        def to(event, **kwargs):
            return EmitEvent(event=event(**kwargs))

        def on_output(event):
            if b'up' in event.text:
                return [to(SignalProcess, signal_number=signal.SIGUSR1,
                           process_matcher=matches_action(a))]
            return [to(ShutdownProcess, process_matcher=matches_action(a)),
                    to(SignalProcess, signal_number='SIGTERM',
                       process_matcher=matches_name('b-1')),
                    to(SignalProcess, signal_number=signal.SIGKILL,
                       process_matcher=matches_pid(c.process_details['pid']))]
        ---
        RegisterEventHandler(OnProcessIO(target_action=a, on_stdout=on_output)),
        b, c, a,
        """
    )
    assert out.status == 0
    assert "[INFO] [a-3]: sending signal 'SIGUSR1' to process[a-3]" in out.lines
    assert "[INFO] [a-3]: sending signal 'SIGINT' to process[a-3]" in out.lines
    died = sorted(line for line in out.lines if 'has died' in line)
    assert 'exit code -15' in ''.join(line for line in died if '[b-1]' in line)
    assert 'exit code -9' in ''.join(line for line in died if '[c-2]' in line)
    assert '[a-3] usr1' in out.lines


def test_signal_without_a_process(launch: Any) -> None:
    """3.9 A signal for a process that never started is an error, for one that ended nothing."""
    entities = """
        from launch.events import matches_action
        from launch.events.process import SignalProcess
        it = ExecuteProcess(cmd=['{program}'])
        signal_it = EmitEvent(event=SignalProcess(
            signal_number='SIGINT', process_matcher=matches_action(it)))
        ---
        it, TimerAction(period=0.3, actions=[signal_it]),
    """
    out = launch(entities.replace('{program}', 'true'))
    assert (out.status, 'ERROR' in out.text) == (0, False)
    launch.write('broken', '#!/no/such/interpreter').chmod(0o755)
    out = launch(entities.replace('{program}', './broken'))
    assert out.status == 1
    assert 'SIGINT' in out.error


def test_events_and_their_names(launch: Any) -> None:
    """3.9 All events can be imported, and matched by their names."""
    out = launch.script(
        """
        from launch.event_handlers import event_named
        from launch.events import ExecutionComplete, IncludeLaunchDescription, Shutdown, TimerEvent
        from launch.events.process import (matches_executable, matches_name, ProcessExited,
                                           ProcessStarted, ProcessStderr, ProcessStdin,
                                           ProcessStdout)
        event = Shutdown(reason='r', due_to_sigint=True)
        print(event.reason, event.due_to_sigint, Shutdown().due_to_sigint, event.name)
        print(event_named(event.name)(event), event_named('other')(event))
        """
    )
    assert out.err == ''
    assert out.stdout.splitlines() == ['r True False launch.events.Shutdown', 'True False']
