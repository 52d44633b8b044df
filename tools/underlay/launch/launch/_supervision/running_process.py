# SPDX-License-Identifier: Apache-2.0
"""Start a process, read its output, and watch for its exit."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from functools import partial
import os
import signal
import threading
from typing import Optional

from launch._supervision.process_group import send_signal
from launch._supervision.program import Child, Program, Spawn
from launch.logging._screen import screen

OnOutput = Callable[[int, bytes], None]

_CHUNK = 65536
_CHUNKS_AT_THE_END = 64


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


class OutputStream:
    """
    Reader of a pipe or a pseudo terminal that passes the data to a callback.

    Nothing is read while the screen is congested, so that the writer blocks (back-pressure).

    Parameters
    ----------
    loop
        The event loop that watches the descriptor.
    descriptor
        The file descriptor to read from; the stream takes ownership of it.
    use
        Called with each piece of the output.

    """

    def __init__(
        self,
        loop: asyncio.AbstractEventLoop,
        descriptor: int,
        use: Callable[[bytes], None],
    ) -> None:
        self._loop = loop
        self._descriptor = descriptor
        self._use = use
        os.set_blocking(descriptor, False)
        loop.add_reader(descriptor, self._on_readable)

    def _on_readable(self) -> None:
        if not screen.is_congested:
            self._read()
            return
        self._loop.remove_reader(self._descriptor)
        screen.when_clear(self._read_on_from_any_thread)

    def _read_on_from_any_thread(self) -> None:
        try:
            self._loop.call_soon_threadsafe(self._read_on)
        except RuntimeError:  # the loop is closed; output is no longer read
            pass

    def _read_on(self) -> None:
        if self._descriptor >= 0:
            self._loop.add_reader(self._descriptor, self._on_readable)

    def _read(self) -> bool:
        """Read once; return whether there may be more."""
        if self._descriptor < 0:
            return False
        try:
            data = os.read(self._descriptor, _CHUNK)
        except (BlockingIOError, InterruptedError):
            return False
        except OSError:  # the other end of a pseudo terminal is closed
            data = b''
        if not data:
            self.close()
            return False
        self._use(data)
        return True

    def drain(self) -> None:
        """Read the data that is available now."""
        for _ in range(_CHUNKS_AT_THE_END):
            if not self._read():
                return

    def close(self) -> None:
        """Stop reading, and close the descriptor."""
        if self._descriptor >= 0:
            self._loop.remove_reader(self._descriptor)
            os.close(self._descriptor)
            self._descriptor = -1


def watch_exit(
    child: Child,
    loop: asyncio.AbstractEventLoop,
) -> asyncio.Future[int]:
    """
    Watch for the exit of a child process, and reap it.

    Parameters
    ----------
    child
        The process.
    loop
        The event loop of the future.

    Returns
    -------
    Future of int
        The exit status, negative for a signal; canceling it ends the watch.

    """
    future: asyncio.Future[int] = loop.create_future()
    try:
        descriptor = os.pidfd_open(child.pid)
    except (AttributeError, OSError):
        _watch_in_thread(child, loop, future)
    else:
        loop.add_reader(descriptor, _reap, child, loop, future, descriptor)
        future.add_done_callback(partial(_unwatch_if_cancelled, loop, descriptor))
    return future


def _unwatch_if_cancelled(
    loop: asyncio.AbstractEventLoop, descriptor: int, future: asyncio.Future[int]
) -> None:
    if future.cancelled():
        loop.remove_reader(descriptor)
        os.close(descriptor)


def _reap(
    child: Child,
    loop: asyncio.AbstractEventLoop,
    future: asyncio.Future[int],
    descriptor: int,
) -> None:
    loop.remove_reader(descriptor)
    os.close(descriptor)
    _finish(future, child.wait())


def _watch_in_thread(
    child: Child,
    loop: asyncio.AbstractEventLoop,
    future: asyncio.Future[int],
) -> None:
    """Wait for the child in a thread, if no pidfd can be opened."""

    def wait() -> None:
        code = child.wait()
        try:
            loop.call_soon_threadsafe(_finish, future, code)
        except RuntimeError:  # the loop is closed; no one is waiting
            pass

    threading.Thread(target=wait, name=f'wait for {child.pid}', daemon=True).start()


def _finish(future: asyncio.Future[int], code: int) -> None:
    if not future.done():
        future.set_result(code)
