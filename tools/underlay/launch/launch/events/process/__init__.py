# SPDX-License-Identifier: Apache-2.0
"""The events of processes."""

from __future__ import annotations

from collections.abc import Callable
import signal
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.event import Event
from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch.events.process.process_matchers import (
        matches_executable,
        matches_name,
        matches_pid,
        ProcessAction,
    )

__all__ = [
    'ProcessExited',
    'ProcessIO',
    'ProcessStarted',
    'ProcessStderr',
    'ProcessStdin',
    'ProcessStdout',
    'ProcessTargetedEvent',
    'RunningProcessEvent',
    'ShutdownProcess',
    'SignalProcess',
    'matches_executable',
    'matches_name',
    'matches_pid',
]


class RunningProcessEvent(Event):
    """
    Base class of events about a process that runs or has run.

    Parameters
    ----------
    action
        The action that started the process.
    name
        The label of the process, with its number.
    cmd
        The command line, as a list of words.
    cwd
        The working directory of the process; None for that of the launch.
    env
        The environment that the process was started with.
    pid
        The id of the process.

    """

    name = 'launch.events.process.RunningProcessEvent'

    def __init__(
        self,
        *,
        action: ProcessAction,
        name: str,
        cmd: list[str],
        cwd: Optional[str],
        env: Optional[dict[str, str]],
        pid: int,
    ) -> None:
        self.__action = action
        self.__name = name
        self.__cmd = cmd
        self.__cwd = cwd
        self.__env = env
        self.__pid = pid

    @property
    def action(self) -> ProcessAction:
        """Return the action that started the process."""
        return self.__action

    @property
    def execute_process_action(self) -> ProcessAction:
        """Return the action that started the process (the older name)."""
        return self.__action

    @property
    def process_name(self) -> str:
        """Return the label of the process."""
        return self.__name

    @property
    def cmd(self) -> list[str]:
        """Return the command line."""
        return self.__cmd

    @property
    def cwd(self) -> Optional[str]:
        """Return the working directory of the process; None for that of the launch."""
        return self.__cwd

    @property
    def env(self) -> Optional[dict[str, str]]:
        """Return the environment that the process was started with."""
        return self.__env

    @property
    def pid(self) -> int:
        """Return the process id."""
        return self.__pid


class ProcessStarted(RunningProcessEvent):
    """Event of a process that was started."""

    name = 'launch.events.process.ProcessStarted'


class ProcessExited(RunningProcessEvent):
    """
    Event of a process that has exited.

    Parameters
    ----------
    returncode
        The exit status, or the negative number of the signal that terminated the process.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessExited'

    def __init__(self, *, returncode: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__returncode = returncode

    @property
    def returncode(self) -> int:
        """Return the exit status, or the negative number of the signal."""
        return self.__returncode


class ProcessIO(RunningProcessEvent):
    """
    Event of bytes that a process wrote, or that are written to it.

    Parameters
    ----------
    text
        The bytes as received, not split into lines.
    fd
        The number of the stream: 0, 1 or 2.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessIO'

    def __init__(self, *, text: bytes, fd: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__text = text
        self.__fd = fd

    @property
    def text(self) -> bytes:
        """Return the bytes as received, not split into lines."""
        return self.__text

    @property
    def from_stdin(self) -> bool:
        """Whether the bytes are for the standard input."""
        return self.__fd == 0

    @property
    def from_stdout(self) -> bool:
        """Whether the bytes come from the standard output."""
        return self.__fd == 1

    @property
    def from_stderr(self) -> bool:
        """Whether the bytes come from the standard error output."""
        return self.__fd == 2


class ProcessStdin(ProcessIO):
    """
    Event of bytes for the standard input of a process.

    Parameters
    ----------
    text
        The bytes that are written to it.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessStdin'

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=0, **kwargs)


class ProcessStdout(ProcessIO):
    """
    Event of bytes that a process wrote to its standard output.

    Parameters
    ----------
    text
        The bytes as received, not split into lines.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessStdout'

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=1, **kwargs)


class ProcessStderr(ProcessIO):
    """
    Event of bytes that a process wrote to its standard error output.

    Parameters
    ----------
    text
        The bytes as received, not split into lines.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessStderr'

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=2, **kwargs)


class ProcessTargetedEvent(Event):
    """
    Base class of events that target certain processes.

    Parameters
    ----------
    process_matcher
        Called with the action of a process; returns whether the event targets it.

    """

    name = 'launch.events.process.ProcessTargetedEvent'

    def __init__(self, *, process_matcher: Callable[[Any], bool]) -> None:
        self.__process_matcher = process_matcher

    @property
    def process_matcher(self) -> Callable[[Any], bool]:
        """Return the matcher."""
        return self.__process_matcher


class ShutdownProcess(ProcessTargetedEvent):
    """Event that requests the termination of the processes that a matcher accepts."""

    name = 'launch.events.process.ShutdownProcess'


class SignalProcess(ProcessTargetedEvent):
    """
    Event that requests sending a signal to certain processes.

    Parameters
    ----------
    signal_number
        The signal, as its name (`'SIGINT'`) or its number.
    process_matcher
        Called with the action of a process; returns whether the event targets it.

    Raises
    ------
    KeyError
        There is no signal with this name.
    ValueError
        There is no signal with this number.

    """

    name = 'launch.events.process.SignalProcess'

    def __init__(
        self,
        *,
        signal_number: Union[str, signal.Signals, int],
        process_matcher: Callable[[Any], bool],
    ) -> None:
        super().__init__(process_matcher=process_matcher)
        self.__signal = (
            signal.Signals[signal_number]
            if isinstance(signal_number, str)
            else signal.Signals(signal_number)
        )

    @property
    def signal(self) -> signal.Signals:
        """Return the signal."""
        return self.__signal

    @property
    def signal_name(self) -> str:
        """Return the name of the signal, such as SIGINT."""
        return self.__signal.name


# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(
    __name__,
    'process_exited',
    'process_io',
    'process_started',
    'process_stderr',
    'process_stdin',
    'process_stdout',
    'process_targeted_event',
    'running_process_event',
    'shutdown_process',
    'signal_process',
)

_ELSEWHERE = {
    'matches_executable': 'process_matchers',
    'matches_name': 'process_matchers',
    'matches_pid': 'process_matchers',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
