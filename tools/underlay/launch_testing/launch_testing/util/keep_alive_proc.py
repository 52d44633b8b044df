# SPDX-License-Identifier: Apache-2.0
"""A process that does nothing."""

from __future__ import annotations

from typing import Any

from launch.actions import ExecuteProcess

# Its standard input stays open and silent; a shell is there faster than a Python.
_WAIT = "trap 'exit 0' INT TERM; while :; do read -r _ || exit 0; done"


class KeepAliveProc(ExecuteProcess):
    """
    Keeps a launch going, whatever its other processes do, until it is shut down.

    Parameters
    ----------
    **kwargs
        Those of `ExecuteProcess`, but for `cmd`.

    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(cmd=['sh', '-c', _WAIT], **{'name': 'keep_alive', **kwargs})
