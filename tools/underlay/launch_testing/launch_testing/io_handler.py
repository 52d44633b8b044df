# SPDX-License-Identifier: Apache-2.0
"""Record the output of the processes of a launch."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, Optional, TYPE_CHECKING

from launch_testing._waiting import Waiting
from launch_testing.tools.text import Expected, matching_text
from launch_testing.util.resolve_processes import resolveProcesses, SomeProcess

if TYPE_CHECKING:
    from launch.actions import ExecuteLocal
    from launch.events.process import ProcessIO

Filter = Callable[[str], str]

_LAST_LINES = 20


class IoHandler:
    """Recorder of process output, in order."""

    def __init__(self) -> None:
        """Create a handler without processes."""
        self._outputs: dict[Any, list[ProcessIO]] = {}  # by the actions of the processes
        self._all: list[ProcessIO] = []

    def track(self, process: ExecuteLocal) -> None:
        """
        Register a process before it writes anything.

        Parameters
        ----------
        process
            The action of the process.

        """
        self._outputs.setdefault(process, [])

    def append(self, process_io: ProcessIO) -> None:
        """
        Add an output event.

        Parameters
        ----------
        process_io
            The event with the output of the process.

        """
        self._outputs.setdefault(process_io.action, []).append(process_io)
        self._all.append(process_io)

    def __iter__(self) -> Iterator[ProcessIO]:
        """Iterate over the output events of all processes."""
        return iter(list(self._all))

    def __getitem__(self, process: SomeProcess) -> list[ProcessIO]:
        """Return the output events of a process, given by its action or name."""
        (action,) = resolveProcesses(self, process=process, strict_proc_matching=True)
        return list(self._outputs[action])

    def processes(self) -> list[ExecuteLocal]:
        """Return the actions of the processes."""
        return list(self._outputs)

    def process_names(self) -> list[str]:
        """Return the labels of the processes."""
        return [(action.process_details or {})['name'] for action in self._outputs]

    def text(self, process: ExecuteLocal, stream: Optional[str] = None) -> str:
        """
        Return the output of a process, decoded as UTF-8.

        Parameters
        ----------
        process
            The action of the process; the output of unknown processes is empty.
        stream
            `stdout` or `stderr`; None for both, in the order of the events.

        """
        return b''.join(
            event.text
            for event in list(self._outputs.get(process, ()))
            if stream is None or event.from_stdout == (stream == 'stdout')
        ).decode('utf-8', 'replace')

    def last_output(self, processes: Iterable[ExecuteLocal]) -> str:
        """
        Format the last lines of output of processes, for error messages.

        Parameters
        ----------
        processes
            The actions of the processes.

        """
        return ''.join(
            f"\n  The last output of '{(each.process_details or {})['name']}':\n"
            + (_indented(self.text(each).splitlines()[-_LAST_LINES:]) or '    (nothing)')
            for each in processes
        )


class ActiveIoHandler(Waiting, IoHandler):
    """Recorder of the output of running processes that supports waiting for output."""

    def __init__(self) -> None:
        """Create a handler without processes."""
        Waiting.__init__(self)
        IoHandler.__init__(self)

    def track(self, process: ExecuteLocal) -> None:
        """
        Register a process before it writes anything, and wake waiting threads.

        Parameters
        ----------
        process
            The action of the process.

        """
        with self.changing():
            super().track(process)

    def append(self, process_io: ProcessIO) -> None:
        """
        Add an output event and wake waiting threads.

        Parameters
        ----------
        process_io
            The event with the output of the process.

        """
        with self.changing():
            super().append(process_io)

    def waitFor(  # noqa: N802
        self,
        expected_output: Expected,
        process: Optional[SomeProcess] = None,
        cmd_args: Any = None,
        output_filter: Optional[Filter] = None,
        timeout: float = 10,
        strict_proc_matching: bool = True,
        strip_ansi_escape_sequences: bool = True,
        stream: Optional[str] = None,
    ) -> bool:
        """
        Wait until a process has written the expected output.

        Parameters
        ----------
        expected_output, process, cmd_args, output_filter
            As for `assertInStream`.
        timeout
            The timeout in s.
        strict_proc_matching, strip_ansi_escape_sequences, stream
            As for `assertInStream`.

        Returns
        -------
        bool
            Whether the output was found; False after the timeout or the end of the launch.

        Raises
        ------
        NoMatchingProcessException
            At the end of the wait, no process matches, or more than one.

        """

        def is_there() -> bool:
            processes = resolveProcesses(
                self,
                process=process,
                cmd_args=cmd_args,
                strict_proc_matching=strict_proc_matching,
            )
            return any(
                matching_text(
                    self,
                    each,
                    expected_output,
                    stream=stream,
                    output_filter=output_filter,
                    strip_ansi_escape_sequences=strip_ansi_escape_sequences,
                )
                for each in processes
            )

        return self.wait_until(is_there, timeout)

    def assertWaitFor(  # noqa: N802
        self,
        expected_output: Expected,
        process: Optional[SomeProcess] = None,
        cmd_args: Any = None,
        output_filter: Optional[Filter] = None,
        timeout: float = 10,
        strict_proc_matching: bool = True,
        strip_ansi_escape_sequences: bool = True,
        stream: Optional[str] = None,
    ) -> None:
        """
        Wait until a process has written the expected output, and fail if it has not.

        Parameters
        ----------
        expected_output, process, cmd_args, output_filter
            As for `assertInStream`.
        timeout
            The timeout in s.
        strict_proc_matching, strip_ansi_escape_sequences, stream
            As for `assertInStream`.

        Raises
        ------
        AssertionError
            The output was not found in time; the message shows the last lines.
        NoMatchingProcessException
            At the end of the wait, no process matches, or more than one.

        """
        if not self.waitFor(
            expected_output,
            process,
            cmd_args,
            output_filter,
            timeout,
            strict_proc_matching,
            strip_ansi_escape_sequences,
            stream,
        ):
            chosen = resolveProcesses(
                self, process=process, cmd_args=cmd_args, strict_proc_matching=False
            )
            shown = getattr(expected_output, 'pattern', expected_output)
            raise AssertionError(
                f'{self.why_in_vain(timeout)} for the output {shown!r}.{self.last_output(chosen)}'
            )


def _indented(lines: Iterable[str]) -> str:
    return '\n'.join(f'    {line}' for line in lines)
