# SPDX-License-Identifier: Apache-2.0
"""Transports of the server: stdin and stdout, or HTTP on this machine."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
import os
import socket
import threading
from typing import Any

from humanoid_common.errors import UserError
from robot_mcp.gate import Gate, LONGEST_BODY

__all__ = ['PATH', 'ServerThread', 'listen', 'serve_http', 'serve_stdio', 'take_stdout']

PATH = '/mcp'
_MOST_SESSIONS = 16
_MOST_CONNECTIONS = 64
_LONGEST_LINE = 256 * 1024
_JOIN_S = 3.0


def take_stdout() -> int:
    """Return a duplicate of stdout for the protocol; redirect all other output to stderr."""
    wire = os.dup(1)
    os.dup2(2, 1)
    return wire


def listen(port: int) -> socket.socket:
    """
    Open a socket that listens on this machine only, at 127.0.0.1.

    Parameters
    ----------
    port
        The port; 0 for any that is free.

    Raises
    ------
    UserError
        The port cannot be used.

    """
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind(('127.0.0.1', port))
        listener.listen(_MOST_CONNECTIONS)  # early clients are queued until the server runs
    except OSError as error:
        listener.close()
        raise UserError(
            f'Port {port} cannot be used ({error.strerror}): choose another one with port:=..., '
            'or 0 for any free port.'
        ) from error
    return listener


async def serve_stdio(server: Any, stdin: int, stdout: int) -> None:
    """
    Serve a single client over two file descriptors, until it closes the first one.

    Parameters
    ----------
    server
        A server of the SDK.
    stdin, stdout
        The descriptors of incoming and outgoing messages, one per line.

    """
    from mcp.server.stdio import stdio_server

    lines: Any = _Lines(stdin)
    async with stdio_server(lines, _Writer(stdout)) as (incoming, outgoing):
        await server.run(incoming, outgoing, server.create_initialization_options())


async def serve_http(server: Any, listener: socket.socket, token: str) -> None:
    """
    Serve HTTP clients that send the token, until the task is canceled.

    Parameters
    ----------
    server
        A server of the SDK.
    listener
        The listening socket.
    token
        The bearer token that clients have to send.

    """
    import uvicorn

    app = server.streamable_http_app(
        streamable_http_path=PATH,
        max_request_body_size=LONGEST_BODY,
        max_sessions=_MOST_SESSIONS,
    )
    config = uvicorn.Config(
        Gate(app, token, listener.getsockname()[1]),
        log_config=None,
        access_log=False,
        server_header=False,
        lifespan='on',
        limit_concurrency=_MOST_CONNECTIONS,
        timeout_keep_alive=10,
        timeout_graceful_shutdown=1,
    )
    await uvicorn.Server(config).serve(sockets=[listener])


class ServerThread:
    """
    Server that runs in a thread of its own.

    Parameters
    ----------
    serve
        Serves until it ends, or until it is canceled.
    at_end
        Called when the server has ended by itself, with the error if there was one.

    """

    def __init__(
        self,
        serve: Callable[[], Awaitable[None]],
        at_end: Callable[[BaseException | None], None],
    ) -> None:
        self._serve, self._at_end = serve, at_end
        self._loop = asyncio.new_event_loop()
        self._task: asyncio.Task[None] | None = None
        self._is_closing = False
        # A daemon: a client that does not read its messages must not keep the process alive.
        self._thread = threading.Thread(target=self._run, name='mcp', daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Stop the server, and cancel what it is doing."""
        self._is_closing = True
        try:
            self._loop.call_soon_threadsafe(self._cancel)
        except RuntimeError:  # it has ended already
            return
        self._thread.join(_JOIN_S)

    def _cancel(self) -> None:
        if self._task is not None:
            self._task.cancel()

    def _run(self) -> None:
        """Run the server, and report its end."""
        asyncio.set_event_loop(self._loop)
        error: BaseException | None = None
        try:
            self._loop.run_until_complete(self._main())
        except asyncio.CancelledError:
            error = None
        except BaseException as raised:  # any error ends the node
            error = raised
        finally:
            self._loop.close()
        if not self._is_closing:
            self._at_end(error)

    async def _main(self) -> None:
        self._task = asyncio.current_task()
        if not self._is_closing:
            await self._serve()


class _Lines:
    """
    Lines from a file descriptor, read by a daemon thread.

    The queue is bounded, so that a client that sends too much has to wait. A line that is too long
    is discarded, and replaced by an invalid message.
    """

    def __init__(self, descriptor: int) -> None:
        self._file = os.fdopen(descriptor, 'rb', closefd=False)
        self._queue: asyncio.Queue[str | None] = asyncio.Queue(16)
        self._loop = asyncio.get_running_loop()
        threading.Thread(target=self._read, name='stdin', daemon=True).start()

    async def __aiter__(self) -> AsyncIterator[str]:
        while (line := await self._queue.get()) is not None:
            yield line

    def _read(self) -> None:
        """Queue one line after another, then None."""
        line: bytes | None = b''
        while line is not None:
            line = self._line()
            text = None if line is None else line.decode(errors='replace')
            try:
                asyncio.run_coroutine_threadsafe(self._queue.put(text), self._loop).result()
            except (RuntimeError, asyncio.CancelledError):  # the loop has ended
                return

    def _line(self) -> bytes | None:
        """Read a line; None at the end of the stream."""
        line = self._file.readline(_LONGEST_LINE)
        if len(line) < _LONGEST_LINE or line.endswith(b'\n'):
            return line or None
        while (rest := self._file.readline(_LONGEST_LINE)) and not rest.endswith(b'\n'):
            continue
        return b'{}\n'


class _Writer:
    """Writer of texts to a file descriptor, in a thread, since the reader may be slow."""

    def __init__(self, descriptor: int) -> None:
        self._file = os.fdopen(descriptor, 'wb', closefd=False)

    async def write(self, text: str) -> None:
        """Write a text."""
        await asyncio.to_thread(self._write, text.encode())

    async def flush(self) -> None:
        """Return immediately: `write` already flushes."""

    def _write(self, data: bytes) -> None:
        try:
            self._file.write(data)
            self._file.flush()
        except BrokenPipeError:  # a client that has gone has closed stdin as well
            return
