# SPDX-License-Identifier: Apache-2.0
"""Request to the template for one process."""

from __future__ import annotations

import asyncio
import marshal
import os
import re
import signal
import socket
from typing import Optional

from launch._supervision.prefork.forked_child import ForkedChild
from launch._supervision.prefork.template_failure import TemplateFailure
from launch._supervision.program import Program

_LAST_WORDS_S = 2.0


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
