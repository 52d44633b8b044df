# SPDX-License-Identifier: Apache-2.0
"""Record the starts and exits of the processes of a launch."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.events.process import ProcessExited
from launch_testing._waiting import Waiting
from launch_testing.util.resolve_processes import resolveProcesses, SomeProcess

if TYPE_CHECKING:
    from launch.actions import ExecuteLocal
    from launch.events.process import ProcessStarted

    ProcessInfo = Union[ProcessStarted, ProcessExited]


class ProcInfoHandler:
    """Recorder of the last start or exit of each process."""

    def __init__(self) -> None:
        """Create a handler without processes."""
        self._infos: dict[Any, ProcessInfo] = {}  # by the actions of the processes

    def append(self, process_info: ProcessInfo) -> None:
        """
        Add a start or exit event, which replaces the previous event of the process.

        Parameters
        ----------
        process_info
            The event.

        """
        self._infos[process_info.action] = process_info

    def __iter__(self) -> Iterator[ProcessInfo]:
        """Iterate over the last event of each process."""
        return iter(list(self._infos.values()))

    def __getitem__(self, process: SomeProcess) -> ProcessInfo:
        """Return the last event of a process, given by its action or name."""
        (action,) = resolveProcesses(self, process=process, strict_proc_matching=True)
        return self._infos[action]

    def processes(self) -> list[ExecuteLocal]:
        """Return the actions of the processes."""
        return list(self._infos)

    def process_names(self) -> list[str]:
        """Return the labels of the processes."""
        return [info.process_name for info in self]


class ActiveProcInfoHandler(Waiting, ProcInfoHandler):
    """Recorder of process starts and exits that supports waiting for them."""

    def __init__(self) -> None:
        """Create a handler without processes."""
        Waiting.__init__(self)
        ProcInfoHandler.__init__(self)

    def append(self, process_info: ProcessInfo) -> None:
        """
        Add a start or exit event and wake waiting threads.

        Parameters
        ----------
        process_info
            The event.

        """
        with self.changing():
            super().append(process_info)

    def waitForStartup(  # noqa: N802
        self, process: SomeProcess, cmd_args: Any = None, *, timeout: float = 10
    ) -> bool:
        """
        Wait until a process has started.

        Parameters
        ----------
        process, cmd_args
            As for `resolveProcesses`; exactly one process must match.
        timeout
            The timeout in s.

        Returns
        -------
        bool
            Whether the process has started in time.

        Raises
        ------
        NoMatchingProcessException
            At the end of the wait, no process matches, or more than one.

        """
        return self.wait_until(lambda: bool(self._matching(process, cmd_args)), timeout)

    def waitForShutdown(  # noqa: N802
        self, process: Optional[SomeProcess], cmd_args: Any = None, *, timeout: float = 10
    ) -> bool:
        """
        Wait until a process, or every process, has ended.

        Parameters
        ----------
        process, cmd_args
            As for `resolveProcesses`; without a process, all started processes are awaited, and
            at least one unless the launch ends.
        timeout
            The timeout in s.

        Returns
        -------
        bool
            Whether the process has ended in time.

        Raises
        ------
        NoMatchingProcessException
            At the end of the wait, no process matches, or more than one.

        """

        def has_ended() -> bool:
            awaited = self._matching(process, cmd_args)
            return (bool(awaited) or self._closed) and all(
                isinstance(self._infos[action], ProcessExited) for action in awaited
            )

        return self.wait_until(has_ended, timeout)

    def assertWaitForStartup(  # noqa: N802
        self, process: SomeProcess, cmd_args: Any = None, *, timeout: float = 10
    ) -> None:
        """
        Wait until a process has started, and fail if it has not.

        Parameters
        ----------
        process, cmd_args, timeout
            As for `waitForStartup`.

        Raises
        ------
        AssertionError
            The process has not started in time.
        NoMatchingProcessException
            At the end of the wait, no process matches, or more than one.

        """
        if not self.waitForStartup(process, cmd_args, timeout=timeout):
            raise AssertionError(f'{self.why_in_vain(timeout)} for the start of {process!r}')

    def assertWaitForShutdown(  # noqa: N802
        self, process: Optional[SomeProcess], cmd_args: Any = None, *, timeout: float = 10
    ) -> None:
        """
        Wait until a process, or every process, has ended, and fail if it has not.

        Parameters
        ----------
        process, cmd_args, timeout
            As for `waitForShutdown`.

        Raises
        ------
        AssertionError
            A process has not ended in time.
        NoMatchingProcessException
            At the end of the wait, no process matches, or more than one.

        """
        if not self.waitForShutdown(process, cmd_args, timeout=timeout):
            running = [
                self._infos[action].process_name
                for action in self._matching(process, cmd_args)
                if not isinstance(self._infos[action], ProcessExited)
            ]
            awaited = ', '.join(running) or 'any process: none has started'
            raise AssertionError(f'{self.why_in_vain(timeout)} for the end of {awaited}')

    def _matching(self, process: Optional[SomeProcess], cmd_args: Any) -> list[ExecuteLocal]:
        return resolveProcesses(
            self, process=process, cmd_args=cmd_args, strict_proc_matching=process is not None
        )
