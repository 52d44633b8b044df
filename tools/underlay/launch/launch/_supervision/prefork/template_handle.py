# SPDX-License-Identifier: Apache-2.0
"""Start the template, and have it make processes."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping, Sequence
import os
import signal
import socket
import subprocess
from typing import Optional

from launch._supervision.orphan_guard import OrphanGuard
from launch._supervision.prefork.eligibility import Kind
from launch._supervision.prefork.fork_request import ForkRequest
from launch._supervision.prefork.forked_child import ForkedChild
from launch._supervision.prefork.template_failure import TemplateFailure
from launch._supervision.program import Program

_PATIENCE_S = 20.0
IDLE_S = 10.0
"""When nothing was forked for so long, all has started that starts together."""


class TemplateHandle:
    """
    Starts a template in a process group of its own, and has it fork programs.

    Parameters
    ----------
    kind
        The kind of the programs.
    environment
        The variables of the template.
    scripts
        The paths of the programs; the template imports what they need.
    guard
        Sees to it that the template is not left behind.

    Attributes
    ----------
    is_open
        Whether the template can fork programs, or is getting ready for it.

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
        """Return the id of the group of processes that the template leads."""
        return self._origin.pid

    async def _live(self) -> None:
        """Get ready, and wait for the end."""
        reason = 'the template has ended'
        try:
            await self._prepare()
            self._ready.set_result(None)
            await self._expect('')
        except (OSError, TemplateFailure) as error:
            reason = str(error)
        self.close(reason)

    async def _prepare(self) -> None:
        """Adopt the copy in which the template goes on once it has imported everything."""
        from launch._supervision.prefork.linux import adopting_orphans

        await self._expect('loaded')
        with adopting_orphans():
            self._control.send(b'settle %d' % os.getpid())
            await self._expect('ready')
        self._origin.wait()

    async def _expect(self, word: str) -> None:
        """Wait for a message; another one than the expected tells of a failure."""
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
            What the process is to become.
        stdout, stderr
            The descriptors that its output goes to.

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
        """Do not end the template for now."""
        if self._retirement is not None:
            self._retirement.cancel()
            self._retirement = None

    def _retire_later(self) -> None:
        """End the template when nobody asks any longer: its memory is then of no use."""
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
        End the template; the programs that were forked from it go on.

        Parameters
        ----------
        reason
            Why, for those who wait until it is ready.

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
    """Take note of the end of all children in a group."""
    try:
        while True:
            os.waitpid(-group, 0)
    except ChildProcessError:
        pass
