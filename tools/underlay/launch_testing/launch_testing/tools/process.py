# SPDX-License-Identifier: Apache-2.0
"""Run processes in a running launch, for the duration of a `with` block."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Optional, TYPE_CHECKING

from launch import LaunchDescription
from launch.events import matches_action
from launch.events.process import ProcessExited, ShutdownProcess
from launch_testing.tools.text import remove_ansi_escape_sequences

if TYPE_CHECKING:
    from launch import LaunchService
    from launch.actions import ExecuteLocal
    from launch_testing.io_handler import ActiveIoHandler
    from launch_testing.proc_info_handler import ActiveProcInfoHandler

__all__ = ['ProcessProxy', 'launch_process']

_SHUTDOWN_TIMEOUT_S = 30.0


class ProcessProxy:
    """
    Proxy that observes a process of a launch and waits for its events.

    Parameters
    ----------
    process_action
        The action of the process, which need not be running yet.
    proc_info, proc_output
        The recorders of the processes of the launch and of their output.
    output_filter
        Filter that is applied to the output first.

    """

    def __init__(
        self,
        process_action: ExecuteLocal,
        proc_info: ActiveProcInfoHandler,
        proc_output: ActiveIoHandler,
        *,
        output_filter: Optional[Callable[[str], str]] = None,
    ) -> None:
        self._action = process_action
        self._proc_info = proc_info
        self._proc_output = proc_output
        self._output_filter = output_filter

    def wait_for_startup(self, timeout: float = 10) -> bool:
        """
        Wait until the process has started, and return whether it has.

        Parameters
        ----------
        timeout
            The timeout in s.

        """
        return self._proc_info.wait_until(lambda: self._is_known, timeout)

    def wait_for_shutdown(self, timeout: float = 10) -> bool:
        """
        Wait until the process has ended, and return whether it has.

        Parameters
        ----------
        timeout
            The timeout in s.

        """
        return self._proc_info.wait_until(lambda: self.terminated, timeout)

    def wait_for_output(
        self,
        condition: Optional[Callable[[str], Any]] = None,
        timeout: Optional[float] = None,
    ) -> bool:
        """
        Wait until the output satisfies a condition, and return whether it does.

        Parameters
        ----------
        condition
            Predicate of the entire output so far; None waits for any output.
        timeout
            The timeout in s; None for 10 s.

        """
        wanted = bool if condition is None else condition
        return self._proc_output.wait_until(
            lambda: bool(wanted(self.output)), 10 if timeout is None else timeout
        )

    @property
    def running(self) -> bool:
        """Whether the process is running."""
        return self._is_known and not self.terminated

    @property
    def terminated(self) -> bool:
        """Whether the process has ended."""
        return self._is_known and isinstance(self._proc_info[self._action], ProcessExited)

    @property
    def exit_code(self) -> int:
        """Return the exit code; raise a RuntimeError if the process has not ended."""
        info = self._proc_info[self._action]
        if not isinstance(info, ProcessExited):
            raise RuntimeError(f"the process '{info.process_name}' has not ended yet")
        return info.returncode

    @property
    def stdout(self) -> str:
        """Return the standard output of the process so far."""
        return self._text('stdout')

    @property
    def stderr(self) -> str:
        """Return the standard error of the process so far."""
        return self._text('stderr')

    @property
    def output(self) -> str:
        """Return the standard output and the standard error of the process so far."""
        return self._text(None)

    @property
    def _is_known(self) -> bool:
        return self._action in self._proc_info.processes()

    def _text(self, stream: Optional[str]) -> str:
        text = remove_ansi_escape_sequences(self._proc_output.text(self._action, stream))
        return text if self._output_filter is None else self._output_filter(text)


@contextmanager
def launch_process(
    launch_service: LaunchService,
    process_action: ExecuteLocal,
    proc_info: ActiveProcInfoHandler,
    proc_output: ActiveIoHandler,
    *,
    output_filter: Optional[Callable[[str], str]] = None,
) -> Iterator[ProcessProxy]:
    """
    Run a process in a launch for the duration of a `with` block.

    Parameters
    ----------
    launch_service
        The service, which is running in another thread.
    process_action
        The action of the process.
    proc_info, proc_output
        The recorders of the processes of the launch and of their output.
    output_filter
        Filter that is applied to the output first.

    Yields
    ------
    ProcessProxy
        The started process. It is shut down at the end if it is still running.

    Raises
    ------
    RuntimeError
        The process has not started in time.

    """
    launch_service.include_launch_description(LaunchDescription([process_action]))
    proxy = ProcessProxy(process_action, proc_info, proc_output, output_filter=output_filter)
    if not proxy.wait_for_startup(timeout=_SHUTDOWN_TIMEOUT_S):
        raise RuntimeError(f'{process_action!r} has not started in {_SHUTDOWN_TIMEOUT_S:g} s')
    try:
        yield proxy
    finally:
        if proxy.running:
            launch_service.emit_event(
                ShutdownProcess(process_matcher=matches_action(process_action))
            )
            proxy.wait_for_shutdown(timeout=_SHUTDOWN_TIMEOUT_S)
