# SPDX-License-Identifier: Apache-2.0
"""Running process with its streams."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from functools import partial
import os
import signal
from typing import Optional

from launch._supervision.exit_watch import watch_exit
from launch._supervision.output_stream import OutputStream
from launch._supervision.process_group import send_signal
from launch._supervision.program import Child, Program, Spawn

OnOutput = Callable[[int, bytes], None]


class RunningProcess:
    """
    Running process in a session and a process group of its own, with its streams.

    Parameters
    ----------
    child
        The process that was started.
    readers
        The read ends of its standard output and error, of which it takes ownership; none if the
        process writes to a file.
    loop
        The event loop that watches them.
    on_output
        Called with the number of the stream, 1 or 2, and the bytes.

    Attributes
    ----------
    exited
        Future of the exit status, negative for a signal.

    """

    def __init__(
        self,
        child: Child,
        readers: Sequence[int],
        *,
        loop: asyncio.AbstractEventLoop,
        on_output: OnOutput,
    ) -> None:
        self._child = child
        self._streams = [
            OutputStream(loop, reader, partial(on_output, number))
            for number, reader in zip((1, 2), readers)
        ]
        self.exited = watch_exit(child, loop)

    @property
    def pid(self) -> int:
        """Return the id of the process, which is also that of its group."""
        return self._child.pid

    def send_signal(self, number: signal.Signals) -> None:
        """
        Send a signal while the process runs; see `launch._supervision.process_group.send_signal`.

        Parameters
        ----------
        number
            The signal.

        """
        if not self.exited.done():
            send_signal(self.pid, number)

    def write(self, data: bytes) -> None:
        """
        Write to the standard input of the process, if it is still open.

        Parameters
        ----------
        data
            The bytes.

        """
        try:
            os.write(self._child.stdin.fileno(), data)  # type: ignore[union-attr]
        except OSError:
            pass

    def drain(self) -> None:
        """Read the output that is available so far."""
        for stream in self._streams:
            stream.drain()

    def close(self) -> None:
        """Close the streams."""
        for stream in self._streams:
            stream.close()
        if self._child.stdin is not None:
            self._child.stdin.close()

    def let_go(self) -> None:
        """Stop watching the process, which continues to run."""
        self.exited.cancel()
        self.close()

    def kill_at_once(self) -> None:
        """Kill the process group, and wait for the process to exit."""
        send_signal(self.pid, signal.SIGKILL)
        self._child.wait()
        self.close()


async def start_process(
    program: Program,
    *,
    spawn: Spawn,
    emulate_tty: bool,
    loop: asyncio.AbstractEventLoop,
    on_output: OnOutput,
    output_path: Optional[str] = None,
) -> RunningProcess:
    """
    Start a program in a session and a group of its own.

    Parameters
    ----------
    program
        The program to start.
    spawn
        Function that starts it, given the two file descriptors for its output.
    emulate_tty
        Whether the output is a pseudo terminal rather than a pipe.
    loop
        The event loop that watches the process and its output.
    on_output
        Called with the number of the stream, 1 or 2, and the bytes.
    output_path
        The file that the process appends its output to; without one, `on_output` receives it.

    Raises
    ------
    OSError
        The program cannot be started, or the file cannot be opened.

    """
    readers, writers = _channels(emulate_tty) if output_path is None else _file(output_path)
    try:
        child = await spawn(program, *writers)
    except BaseException:
        _close(readers)
        raise
    finally:
        _close(writers)
    return RunningProcess(child, readers, loop=loop, on_output=on_output)


def _channels(emulate_tty: bool) -> tuple[Sequence[int], Sequence[int]]:
    """Open two pipes or pseudo terminals; return the read ends and the write ends."""
    readers, writers = zip(*[os.openpty() if emulate_tty else os.pipe() for _ in range(2)])
    return readers, writers


def _file(path: str) -> tuple[Sequence[int], Sequence[int]]:
    """Open a file for both streams; return no read ends, and two write ends."""
    flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC
    return (), [os.open(path, flags, 0o666) for _ in range(2)]


def _close(descriptors: Sequence[int]) -> None:
    for descriptor in descriptors:
        os.close(descriptor)
