# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.10: shutdown and signals."""

from __future__ import annotations

import os
import pty
import signal
import time
from typing import Any

import pytest


def _waiting(trap: str) -> str:
    """Return the text of a process that does something on SIGINT and goes on."""
    return f"""
    ExecuteProcess(cmd=['sh', '-c', 'trap "{trap}" INT; echo up $$; while :; do sleep 0.1; done'],
                   output='screen', name='it'),
    """


def test_escalation(launch: Any) -> None:
    """3.10 SIGINT, then SIGTERM, and SIGKILL after the sum of both times; each is told."""
    # The genuine launch performs the times at the shutdown, when the scope of the process is gone.
    run = launch.start(
        """
        script = 'trap "" INT TERM; echo up; while :; do sleep 0.1; done'
        ---
        SetLaunchConfiguration('k', '0.25'),
        ExecuteProcess(cmd=['sh', '-c', script], name='it', output='screen',
                       sigterm_timeout='0.5', sigkill_timeout=LaunchConfiguration('k')),
        SetLaunchConfiguration('k', '60'),
        """
    )
    out = run.wait_for('[it-1] up').send(signal.SIGINT).end()
    assert out.lines[2:] == [
        '[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)',
        "[INFO] [it-1]: sending signal 'SIGINT' to process[it-1]",
        "[ERROR] [it-1]: process[it-1] failed to terminate '0.5' seconds after receiving "
        "'SIGINT', escalating to 'SIGTERM'",
        "[INFO] [it-1]: sending signal 'SIGTERM' to process[it-1]",
        "[ERROR] [it-1]: process[it-1] failed to terminate '0.75' seconds after receiving "
        "'SIGTERM', escalating to 'SIGKILL'",
        "[INFO] [it-1]: sending signal 'SIGKILL' to process[it-1]",
        '[ERROR] [it-1]: process has died [pid N, exit code -9, cmd \'sh -c trap "" INT TERM; '
        "echo up; while :; do sleep 0.1; done'].",
    ]
    assert out.status == 0


def test_times_from_the_command_line(launch: Any) -> None:
    """3.10 The times default to launch arguments, which default to 5 seconds."""
    text = _waiting('')
    run = launch.start(text, 'sigterm_timeout:=1', 'sigkill_timeout:=9')
    out = run.wait_for('[it-1] up').send(signal.SIGINT).end()
    assert "failed to terminate '1' seconds after receiving 'SIGINT'" in out.text
    assert 'exit code -15' in out.text
    run = launch.start(text)
    began = time.monotonic()
    out = run.wait_for('[it-1] up').send(signal.SIGINT).end()
    assert "failed to terminate '5' seconds after receiving 'SIGINT'" in out.text
    assert time.monotonic() - began > 4.9


def test_second_interrupt(launch: Any) -> None:
    """3.10 Later interrupts are told and ignored; the status is 0 all the same."""
    run = launch.start(
        """
        script = 'trap "echo ouch" INT; echo up; while [ ! -f end ]; do sleep 0.1; done'
        ---
        ExecuteProcess(cmd=['sh', '-c', script], output='screen', name='it'),
        """
    )
    run.wait_for('[it-1] up').send(signal.SIGINT)
    run.wait_for('[it-1] ouch').send(signal.SIGINT)
    run.wait_for('again, ignoring...')
    (launch.here / 'end').touch()
    out = run.end()
    first = '[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)'
    told = [line for line in out.lines if 'user interrupted' in line]
    assert told == [first, first + ' again, ignoring...']
    assert out.lines.count('[it-1] ouch') == 1
    assert out.status == 0


def test_reason_of_an_interrupt(launch: Any) -> None:
    """3.10 Handlers learn that it was Ctrl-C."""
    run = launch.start(
        """
        RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: LogInfo(
            msg=f'{event.reason} {event.due_to_sigint}'))),
        """
        + _waiting('exit 0')
    )
    out = run.wait_for('[it-1] up').send(signal.SIGINT).end()
    assert out.said == ['ctrl-c (SIGINT) True']
    assert '[INFO] [it-1]: process has finished cleanly [pid N]' in out.lines


@pytest.mark.parametrize('number', [signal.SIGTERM, signal.SIGQUIT, signal.SIGHUP])
def test_other_signals(number: signal.Signals, launch: Any, alive: Any) -> None:
    """3.10 SIGTERM and its like end the launch and its processes (section 6)."""
    text = _waiting('exit 0')
    run = launch.start(text).wait_for('[it-1] up')
    child = int(run.stdout.partition('[it-1] up ')[2].split()[0])
    out = run.send(number).end()
    assert out.status == 0
    assert "[INFO] [it-1]: sending signal 'SIGINT' to process[it-1]" in out.lines
    assert not alive(child)


@pytest.mark.parametrize('options', [[], ['--noninteractive']])
def test_interrupt_at_a_terminal(options: list[str], launch: Any) -> None:
    """3.10 Ctrl-C at a terminal ends everything, each process interrupted once (issue)."""
    launch.write('it.launch.py', _waiting('echo INT; exit 0'))
    main, terminal = pty.openpty()
    run = launch.run('launch', *options, 'it.launch.py', stdin=terminal)
    os.close(terminal)
    run.wait_for('[it-1] up').send(signal.SIGINT)
    out = run.end()
    os.close(main)
    assert out.status == 0
    assert out.lines.count('[it-1] INT') == 1


def test_nothing_starts_during_shutdown(launch: Any) -> None:
    """3.10 A process visited in a shutdown is skipped; one on its way is interrupted at once."""
    out = launch(
        """
        RegisterEventHandler(OnShutdown(on_shutdown=[
            ExecuteProcess(cmd=['rec', 'late']), Node(package='stub', executable='rec')])),
        Shutdown(),
        ExecuteProcess(cmd=['sleep', '60']),
        """
    )
    assert (out.status, out.runs) == (0, [])
    started = [line for line in out.lines if 'started' in line]
    assert started == ['[INFO] [sleep-1]: process started with pid [N]']
    assert any('exit code -2' in line for line in out.lines)


def test_killed_launch_leaves_nothing(launch: Any, alive: Any) -> None:
    """3.10 Even SIGKILL to the launch ends its processes (issue)."""
    text = _waiting('')
    arguments = ['sigterm_timeout:=0.2', 'sigkill_timeout:=0.2']
    run = launch.start(text, *arguments).wait_for('[it-1] up')
    child = int(run.stdout.partition('[it-1] up ')[2].split()[0])
    assert alive(child)
    run.send(signal.SIGKILL)
    assert run.end().status == -9
    end = time.monotonic() + 100.0
    while alive(child):
        assert time.monotonic() < end
        time.sleep(0.05)


def test_each_process_leads_a_group(launch: Any) -> None:
    """3.10 A process has a group of its own, so that all of it can be signalled (issue)."""
    out = launch(
        """
        script = 'echo $$ $(cut -d" " -f5 /proc/$$/stat)'
        ---
        ExecuteProcess(cmd=['sh', '-c', script], output='screen'),
        """
    )
    (line,) = (line for line in out.lines if line.startswith('[sh-1]'))
    pid, group = line.split()[1:]
    assert pid == group


def test_descendants_end_too(launch: Any, alive: Any) -> None:
    """3.10 What a process has started ends with it (issue)."""
    run = launch.start(
        """
        ExecuteProcess(
            cmd=['sh', '-c', 'sleep 60 & echo up $!; wait'], output='screen', name='it'),
        """
    ).wait_for('[it-1] up')
    grandchild = int(run.stdout.partition('[it-1] up ')[2].split()[0])
    assert alive(grandchild)
    out = run.send(signal.SIGINT).end()
    assert out.status == 0
    assert not alive(grandchild)
