# SPDX-License-Identifier: Apache-2.0
"""Start the template, and request processes from it."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping, Sequence
import marshal
import os
import re
import signal
import socket
import subprocess
from typing import IO, Optional

from launch._supervision.orphan_guard import OrphanGuard
from launch._supervision.prefork.prefork import Kind, TemplateFailure
from launch._supervision.program import Program

_PATIENCE_S = 20.0
IDLE_S = 10.0
"""Time in s without a fork after which the template is terminated: all programs have started."""
_LAST_WORDS_S = 2.0


class TemplateHandle:
    """
    Handle of a template, in a process group of its own, that forks programs on request.

    Parameters
    ----------
    kind
        The kind of the programs.
    environment
        The variables of the template.
    scripts
        The paths of the programs; the template imports their modules.
    guard
        The guard that kills the template if it is left behind.

    Attributes
    ----------
    is_open
        Whether the template can fork programs, or is still starting.

    Raises
    ------
    OSError
        The template cannot be started.

    """

    def __init__(
        self,
        kind: Kind,
        environment: Mapping[str, str],
        scripts: Sequence[str],
        guard: OrphanGuard,
    ) -> None:
        self._guard = guard
        self.is_open = True
        self._kind = kind
        self._control, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self._control.setblocking(False)
        with theirs:
            self._origin = _start(kind, environment, theirs.fileno(), scripts)
        guard.add(self.group)
        self._asked = 0
        self._retirement: Optional[asyncio.TimerHandle] = None
        self._ready: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._life = asyncio.ensure_future(self._live())

    @property
    def group(self) -> int:
        """Return the process group id of the template."""
        return self._origin.pid

    async def _live(self) -> None:
        """Prepare the template, and wait until it exits."""
        reason = 'the template has ended'
        try:
            await self._prepare()
            self._ready.set_result(None)
            await self._expect('')
        except (OSError, TemplateFailure) as error:
            reason = str(error)
        self.close(reason)

    async def _prepare(self) -> None:
        """Adopt the copy in which the template continues after its imports."""
        from launch._supervision.prefork.linux import adopting_orphans

        await self._expect('loaded')
        with adopting_orphans():
            self._control.send(b'settle %d' % os.getpid())
            await self._expect('ready')
        self._origin.wait()

    async def _expect(self, word: str) -> None:
        """Wait for a message; raise a TemplateFailure if it is not the expected one."""
        loop = asyncio.get_running_loop()
        message = (await loop.sock_recv(self._control, 1100)).decode('utf-8', 'replace')
        if message != word:
            raise TemplateFailure(message or 'the template has ended')

    async def fork(self, program: Program, stdout: int, stderr: int) -> ForkedChild:
        """
        Fork a process that runs a program from the template.

        Parameters
        ----------
        program
            The program to run in the process.
        stdout, stderr
            The file descriptors for its output.

        Raises
        ------
        TemplateFailure
            The program could not be forked, and was not started.

        """
        self._asked += 1
        self._stay()
        try:
            await asyncio.wait_for(asyncio.shield(self._ready), _PATIENCE_S)
            request = ForkRequest(self._kind.interpreter, program)
            return await self._make(request, stdout, stderr)
        except (OSError, asyncio.TimeoutError) as error:
            self.close()
            raise TemplateFailure(str(error) or 'the template does not answer') from None
        finally:
            self._asked -= 1
            if self.is_open and not self._asked:
                self._retire_later()

    def _stay(self) -> None:
        """Cancel the scheduled termination of the template."""
        if self._retirement is not None:
            self._retirement.cancel()
            self._retirement = None

    def _retire_later(self) -> None:
        """Schedule the termination of the idle template, to free its memory."""
        loop = asyncio.get_running_loop()
        self._retirement = loop.call_later(IDLE_S, self.close, 'nothing was forked for a while')

    async def _make(self, request: ForkRequest, stdout: int, stderr: int) -> ForkedChild:
        try:
            request.send(self._control, stdout, stderr)
            return await asyncio.wait_for(request.process(), _PATIENCE_S)
        except BaseException:
            self.close()
            request.give_up()
            raise

    def close(self, reason: str = 'the template was ended') -> None:
        """
        Terminate the template; the programs that were forked from it continue to run.

        Parameters
        ----------
        reason
            The reason, for callers that wait until it is ready.

        """
        if not self.is_open:
            return
        self.is_open = False
        self._stay()
        self._life.cancel()
        if not self._ready.done():
            self._ready.set_exception(TemplateFailure(reason))
            self._ready.exception()
        self._control.close()
        os.killpg(self.group, signal.SIGKILL)
        self._origin.wait()
        _reap(self.group)
        self._guard.remove(self.group)


def _start(
    kind: Kind,
    environment: Mapping[str, str],
    descriptor: int,
    scripts: Sequence[str],
) -> subprocess.Popen[bytes]:
    template = os.path.join(os.path.dirname(__file__), 'template.py')
    return subprocess.Popen(
        [kind.interpreter, template, str(descriptor), kind.preloader, *scripts],
        cwd='/',
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        pass_fds=[descriptor],
        start_new_session=True,
    )


def _reap(group: int) -> None:
    """Reap all children in a process group."""
    try:
        while True:
            os.waitpid(-group, 0)
    except ChildProcessError:
        pass


class ForkRequest:
    """
    Launch side of the connection to a process that is being forked.

    The template sends the process id, and the process itself `+` when it is set up. It waits for
    the launch before it runs the program, and exits if the launch gives up.

    Parameters
    ----------
    interpreter
        The Python interpreter to show in its command line.
    program
        The program to run in the process.

    Raises
    ------
    TemplateFailure
        The command line and the environment are too long.

    """

    def __init__(self, interpreter: str, program: Program) -> None:
        self._ours, self._theirs = socket.socketpair()
        self._ours.setblocking(False)
        self._stdin_read, self._stdin_write = os.pipe()
        self._answer = ''
        content = {
            'interpreter': interpreter,
            'command': list(program.command),
            'cwd': os.path.abspath(program.cwd or os.curdir),
            'env': dict(os.environ if program.env is None else program.env),
        }
        data = marshal.dumps(content)
        data = b'%d\n%s' % (len(data), data)
        if self._ours.send(data) != len(data):
            raise TemplateFailure('the command line and the environment are too long')

    def send(self, control: socket.socket, stdout: int, stderr: int) -> None:
        """
        Send the other end to the template, with the standard streams.

        Parameters
        ----------
        control
            The connection to the template.
        stdout, stderr
            The file descriptors for the output of the process.

        """
        streams = [self._stdin_read, stdout, stderr]
        socket.send_fds(control, [b'fork'], [*streams, self._theirs.fileno()])
        self._theirs.close()
        os.close(self._stdin_read)
        self._stdin_read = -1

    async def process(self) -> ForkedChild:
        """Wait until the process is set up, start it and return it."""
        loop = asyncio.get_running_loop()
        while not re.fullmatch(r'\+?\d+\n\+?', self._answer) or '+' not in self._answer:
            data = await loop.sock_recv(self._ours, 1100)
            if not data:
                raise TemplateFailure(self._answer or 'the template has ended')
            self._answer += data.decode('utf-8', 'replace')
        self._ours.send(b'+')
        self._ours.close()
        return ForkedChild(self._pid() or 0, os.fdopen(self._stdin_write, 'wb', buffering=0))

    def _pid(self) -> Optional[int]:
        found = re.search(r'(\d+)\n', self._answer)
        return None if found is None else int(found[1])

    def give_up(self) -> None:
        """Kill the process if there is one; it has not started its program."""
        if self._stdin_read >= 0:
            os.close(self._stdin_read)
        os.close(self._stdin_write)
        self._theirs.close()
        self._read_last_words()
        pid = self._pid()
        if pid is not None:
            _kill_and_reap(pid)

    def _read_last_words(self) -> None:
        """Read until the other end is closed."""
        with self._ours as connection:
            connection.settimeout(_LAST_WORDS_S)
            try:
                connection.shutdown(socket.SHUT_WR)
                while data := connection.recv(1100):
                    self._answer += data.decode('utf-8', 'replace')
            except OSError:
                pass


def _kill_and_reap(pid: int) -> None:
    try:
        if os.waitpid(pid, os.WNOHANG)[0] == 0:
            os.kill(pid, signal.SIGKILL)
            os.waitpid(pid, 0)
    except ChildProcessError:
        pass  # it has exited together with the template


class ForkedChild:
    """
    Child process forked from the template, with the interface of `subprocess.Popen`.

    Parameters
    ----------
    pid
        The id of the process.
    stdin
        The write end of its standard input pipe.

    """

    def __init__(self, pid: int, stdin: IO[bytes]) -> None:
        self.pid = pid
        self.stdin = stdin
        self._code: Optional[int] = None

    def wait(self) -> int:
        """Wait for the process to exit; return the exit status, negative for a signal."""
        if self._code is None:
            self._code = os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])
        return self._code
