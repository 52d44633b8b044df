# SPDX-License-Identifier: Apache-2.0
"""A child process that was not executed, but forked from the template."""

from __future__ import annotations

import os
from typing import IO, Optional


class ForkedChild:
    """
    A child process that was forked from the template, to be used as a `subprocess.Popen`.

    Parameters
    ----------
    pid
        The id of the process.
    stdin
        The end to write to of its standard input.

    """

    def __init__(self, pid: int, stdin: IO[bytes]) -> None:
        self.pid = pid
        self.stdin = stdin
        self._code: Optional[int] = None

    def wait(self) -> int:
        """Wait for the end; return the exit status, negative for a signal."""
        if self._code is None:
            self._code = os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])
        return self._code
