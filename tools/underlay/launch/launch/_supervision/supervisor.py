# SPDX-License-Identifier: Apache-2.0
"""Supervise the process of an action, from start to exit, and pass the events of the launch on."""

from __future__ import annotations

import asyncio
from functools import partial
import logging
import signal
from typing import Any, Optional, TYPE_CHECKING

from launch._before_start import explain_spawn_failure
from launch._supervision.process_group import end_leftovers, Escalation
from launch._supervision.process_output import ProcessReport
from launch._supervision.program import execute, PerformedOptions, Program, ProgramOwner
from launch._supervision.running_process import RunningProcess, start_process
from launch.event import Event
from launch.event_handler import BaseEventHandler
from launch.events import Shutdown
from launch.events.process import ProcessStdin, ProcessTargetedEvent, SignalProcess
from launch.logging import get_logger, launch_config

if TYPE_CHECKING:
    from launch._supervision.remainder import EscapedProcesses
    from launch.launch_context import LaunchContext

_EVENTS = (ProcessTargetedEvent, ProcessStdin, Shutdown)


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
        self._run = context.run
        self._loop = loop
        self._details: dict[str, Any] = action.description_of_process()
        self._label: str = self._details['name']
        self._logger: logging.Logger = get_logger(self._label)
        self._report = ProcessReport(action, self._details, options, context)
        self.output = self._report.output
        self.return_code: Optional[int] = None
        self._process: Optional[RunningProcess] = None
        self._escalation: Optional[Escalation] = None
        self._escaped: Optional[EscapedProcesses] = None
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
            self._report_end(process, self.return_code)
            await end_leftovers(process.pid, was_interrupted=self._escalation is not None)
            if self._escaped is not None:
                await self._escaped.end(*self._options.timeouts_s)
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
                on_output=self._report.feed,
                output_path=self._output_path(),
            )
        except (OSError, ValueError) as error:
            self._logger.error('%s', explain_spawn_failure(self._details, error))
            self._logger.debug('the traceback of it', exc_info=True)
            self._run.note_failure(127)
            return None
        if self._run.processes is not None and not self._is_detached:
            self._run.processes.add(process, *self._options.timeouts_s)
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
        self._report.start(process.pid)
        if self._stopped.done():
            self._begin_escalation()

    def _report_end(self, process: RunningProcess, status: int) -> None:
        if self._escalation is not None:
            self._escalation.cancel()
        process.drain()
        self._report.end(status, was_interrupted=self._escalation is not None)

    def _forget(self, process: RunningProcess) -> None:
        """Release a process that has exited; one that has not is left to the registry."""
        self._process = None
        self._report.pid = 0
        if process.exited.done():
            process.close()
            if self._run.processes is not None and not self._is_detached:
                self._run.processes.remove(process)

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
        if self._escaped is None:
            from launch._supervision.remainder import EscapedProcesses

            self._escaped = EscapedProcesses()
        self._escaped.note(process.pid, processes.descendants(process.pid), number)
        process.send_signal(number)
        self._escaped.send(number)


class ProcessControl(BaseEventHandler):
    """
    Event handler that forwards the events that target a process to its supervisor.

    Parameters
    ----------
    action
        The action that runs the process, which identifies its events.
    supervisor
        The supervisor of the process.

    """

    def __init__(self, action: object, supervisor: Supervisor) -> None:
        super().__init__(matcher=self.matches)
        self._action = action
        self._supervisor = supervisor

    def matches(self, event: Event) -> bool:
        """
        Whether an event targets the process, or all processes.

        Parameters
        ----------
        event
            The event that was emitted.

        """
        if not isinstance(event, _EVENTS):  # most are not; each process is asked about each event
            return False
        if isinstance(event, ProcessTargetedEvent):
            return event.process_matcher(self._action)
        if isinstance(event, ProcessStdin):
            return event.action is self._action
        return True

    def handle(self, event: Event, context: LaunchContext) -> None:
        """
        Terminate the process, send it a signal, or write to it, depending on the event.

        Parameters
        ----------
        event
            An event that `matches` accepts.
        context
            As for `BaseEventHandler.handle`.

        """
        super().handle(event, context)
        if isinstance(event, SignalProcess):
            self._supervisor.send_signal(event.signal)
        elif isinstance(event, ProcessStdin):
            self._supervisor.write(event.text)
        elif isinstance(event, Shutdown):
            self._supervisor.end_with_launch()
        else:
            self._supervisor.stop()
