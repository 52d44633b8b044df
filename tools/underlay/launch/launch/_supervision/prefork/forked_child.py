# SPDX-License-Identifier: Apache-2.0
"""Child process that was forked from the template rather than executed."""

from __future__ import annotations

import os
from typing import IO, Optional


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
