# SPDX-License-Identifier: Apache-2.0
"""Supervise the process of an action, from start to exit."""

from __future__ import annotations

import asyncio
from functools import partial
import logging
import signal
from typing import Any, Optional, TYPE_CHECKING

from launch._checks.programs import explain_spawn_failure
from launch._supervision.process_group import end_leftovers, Escalation
from launch._supervision.process_output import LineFormat, ProcessOutput
from launch._supervision.program import execute, PerformedOptions, Program, ProgramOwner
from launch._supervision.running_process import RunningProcess, start_process
from launch.events.process import ProcessExited, ProcessStarted, ProcessStderr, ProcessStdout
from launch.logging import get_logger, launch_config

if TYPE_CHECKING:
    from launch._supervision.member import Member
    from launch.launch_context import LaunchContext
    from launch.launch_run import RunningProcesses


class Supervisor:
    """
    Supervisor that starts, monitors and respawns a process, and terminates it on shutdown.

    Parameters
    ----------
    action
        The action that runs the process, which is already prepared.
    options
        How the process is to be run.
    context
        The launch context, to which events are emitted.
    loop
        The event loop that runs the supervision task.

    Attributes
    ----------
    output
        The logging of the output.
    return_code
        The exit status, negative for a signal; None before the process has exited.
    task
        Task that is done when the process has exited and is not respawned.

    """

    def __init__(
        self,
        action: ProgramOwner,
        options: PerformedOptions,
        context: LaunchContext,
        loop: asyncio.AbstractEventLoop,
    ) -> None:
        self._action = action
        self._options = options
        self._context = context
        self._run = context.run
        self._loop = loop
        self._details: dict[str, Any] = action.description_of_process()
        self._label: str = self._details['name']
        self._logger: logging.Logger = get_logger(self._label)
        self.output = ProcessOutput(
            self._label,
            options.output,
            LineFormat(options.output_format, action),
            keep=options.cached_output,
        )
        self.return_code: Optional[int] = None
        self._process: Optional[RunningProcess] = None
        self._escalation: Optional[Escalation] = None
        self._escaped: list[Member] = []
        self._is_detached = options.detached or self._is_detached_by_environment()
        self._stopped = loop.create_future()
        self._let_go = loop.create_future()
        self.task = loop.create_task(self._supervise())

    @property
    def details(self) -> dict[str, Any]:
        """Return the details of the process; `pid` is set once it has started."""
        return self._details

    # Requests.

    def stop(self) -> None:
        """Terminate the process, and do not respawn it."""
        if not self._stopped.done():
            self._stopped.set_result(None)
        if self._process is None:
            self._stop_waiting()
        elif self._escalation is None:
            self._begin_escalation()

    def end_with_launch(self) -> None:
        """Terminate the process on shutdown, or stop watching it if it is detached."""
        if self._is_detached and not self._let_go.done():
            self._let_go.set_result(None)
        if not self._is_detached or self._process is None:
            self.stop()

    def send_signal(self, number: signal.Signals) -> None:
        """
        Send a signal to the process; do nothing if it has already exited.

        Parameters
        ----------
        number
            The signal.

        Raises
        ------
        RuntimeError
            The process has not been started yet.

        """
        if self._process is None:
            if self.return_code is not None:
                self._logger.debug("signal '%s' not sent: it has ended already", number.name)
                return
            raise RuntimeError(
                f"the signal '{number.name}' cannot be sent to process[{self._label}], which is "
                'not running'
            )
        self._logger.info("sending signal '%s' to process[%s]", number.name, self._label)
        self._process.send_signal(number)

    def write(self, data: bytes) -> None:
        """
        Write to the standard input of the process, if it runs.

        Parameters
        ----------
        data
            The bytes.

        """
        if self._process is not None:
            self._process.write(data)

    def _stop_waiting(self) -> None:
        """Speed up a pending start if the launch is shutting down."""
        if self._run.is_shutdown and self._run.processes is not None:
            self._run.processes.hurry()

    # Life cycle of the process.

    async def _supervise(self) -> None:
        respawned = 0
        while not self._run.is_shutdown and not self._stopped.done():
            if not await self._run_once():
                return
            if not self._options.may_respawn(respawned):
                return
            respawned += 1
            await self._wait_before_respawn()

    async def _wait_before_respawn(self) -> None:
        delay = self._options.respawn_delay
        if delay and not self._stopped.done():
            await asyncio.wait([self._stopped], timeout=delay)

    async def _run_once(self) -> bool:
        """Run the process until it exits; return False if it failed to start or was let go."""
        process = await self._start()
        if process is None:
            return False
        self._process = process
        try:
            self._report_start(process)
            if self._is_detached and not await self._ends_before_launch(process):
                return False
            self.return_code = await process.exited
            self._report_end(process)
            await end_leftovers(process.pid, was_interrupted=self._escalation is not None)
            await self._end_escaped()
            process.drain()
            self.output.flush()
        finally:
            self._forget(process)
        return True

    def _is_detached_by_environment(self) -> bool:
        processes = self._run.processes
        return processes is not None and processes.detaches(self._details['env'])

    async def _ends_before_launch(self, process: RunningProcess) -> bool:
        """Wait for a process or the launch to end; on the latter, let go and return False."""
        await asyncio.wait([process.exited, self._let_go], return_when=asyncio.FIRST_COMPLETED)
        if process.exited.done() or self._stopped.done():
            return True
        self._logger.info('process continues without the launch [pid %s]', process.pid)
        process.let_go()
        return False

    async def _start(self) -> Optional[RunningProcess]:
        processes = self._run.processes
        try:
            process = await start_process(
                self._program(),
                spawn=execute if processes is None else processes.spawn,
                emulate_tty=self._options.emulate_tty,
                loop=self._loop,
                on_output=self._on_output,
                output_path=self._output_path(),
            )
        except (OSError, ValueError) as error:
            self._logger.error('%s', explain_spawn_failure(self._details, error))
            self._logger.debug('the traceback of it', exc_info=True)
            self._run.note_failure(127)
            return None
        if self._run.processes is not None and not self._is_detached:
            self._run.processes.add(
                process, float(self._options.sigterm_timeout), float(self._options.sigkill_timeout)
            )
        return process

    def _output_path(self) -> Optional[str]:
        """Return the output file of a detached process, which may outlive the launch, or None."""
        return launch_config.get_log_file_path(f'{self._label}.log') if self._is_detached else None

    def _program(self) -> Program:
        details = self._details
        return Program(
            command=details['cmd'],
            cwd=details['cwd'],
            env=details['env'],
            shell=self._options.shell,
            preloader=self._action.preloader,
            detached=self._is_detached,
        )

    def _report_start(self, process: RunningProcess) -> None:
        self._details['pid'] = process.pid
        if self._options.log_cmd:
            self._logger.info(
                "process details: cmd='%s', cwd='%s', custom_env?=%s",
                self._command_line(),
                self._details['cwd'],
                self._details['env'] is not None,
            )
        self._logger.info('process started with pid [%s]', process.pid)
        self._context.emit_event_sync(ProcessStarted(**self._event_details()))
        if self._stopped.done():
            self._begin_escalation()

    def _report_end(self, process: RunningProcess) -> None:
        if self._escalation is not None:
            self._escalation.cancel()
        process.drain()
        self.output.flush()
        if self.return_code == 0:
            self._logger.info('process has finished cleanly [pid %s]', process.pid)
        else:
            self._report_failure(process)
        self._context.emit_event_sync(
            ProcessExited(returncode=self.return_code or 0, **self._event_details())
        )

    def _report_failure(self, process: RunningProcess) -> None:
        self._logger.error(
            "process has died [pid %s, exit code %s, cmd '%s'].",
            process.pid,
            self.return_code,
            self._command_line(),
        )
        if self._escalation is None:
            self._run.note_failure(self.return_code or 0)
            self.output.show_last_lines()

    def _forget(self, process: RunningProcess) -> None:
        """Release a process that has exited; one that has not is left to the registry."""
        self._process = None
        if process.exited.done():
            process.close()
            if self._run.processes is not None and not self._is_detached:
                self._run.processes.remove(process)

    def _on_output(self, stream: int, data: bytes) -> None:
        self.output.feed(stream, data)
        event_class = ProcessStdout if stream == 1 else ProcessStderr
        event = event_class(text=data, **self._event_details())
        if self._context.would_handle_event(event):
            self._context.emit_event_sync(event)

    def _begin_escalation(self) -> None:
        process = self._process
        if process is None:
            return
        self._escalation = Escalation(
            label=self._label,
            logger=self._logger,
            send=partial(self._send, process),
            sigterm_timeout=self._options.sigterm_timeout,
            sigkill_timeout=self._options.sigkill_timeout,
        )
        self._escalation.begin(self._loop)
        if self._run.is_shutdown and self._run.processes is not None:
            self._run.processes.end_remainder()

    def _send(self, process: RunningProcess, number: signal.Signals) -> None:
        """Send a signal to the group of a process, and to its descendants outside the group."""
        processes = None if self._run.is_shutdown else self._run.processes
        if processes is None:  # the launch itself terminates all processes outside the groups
            process.send_signal(number)
            return
        self._note_escaped(process, processes, number)
        process.send_signal(number)
        if self._escaped:
            from launch._supervision.member import send

            for member in self._escaped:
                send(member, number)

    def _note_escaped(
        self, process: RunningProcess, processes: RunningProcesses, number: signal.Signals
    ) -> None:
        """Record the descendants outside the group while their ancestry is known."""
        from launch._supervision.member import is_alive

        with_nested = number == signal.SIGKILL
        news = (
            member
            for member in processes.descendants(process.pid)
            if member.group != process.pid and (with_nested or not member.is_nested)
        )
        self._escaped = list(dict.fromkeys([*filter(is_alive, self._escaped), *news]))

    async def _end_escaped(self) -> None:
        """Terminate the descendants that have survived the signals sent to the process."""
        if not self._escaped:
            return
        from launch._supervision.member import is_alive
        from launch._supervision.remainder import end_members

        await end_members(
            lambda number: [member for member in self._escaped if is_alive(member)],
            float(self._options.sigterm_timeout),
            float(self._options.sigkill_timeout),
            interrupted=self._escaped,
        )
        self._escaped = []

    def _command_line(self) -> str:
        return ' '.join(self._details['cmd'])

    def _event_details(self) -> dict[str, Any]:
        return {
            'action': self._action,
            'pid': self._process.pid if self._process else 0,
            **{key: self._details[key] for key in ('name', 'cmd', 'cwd', 'env')},
        }
