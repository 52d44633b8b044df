# SPDX-License-Identifier: Apache-2.0
"""Idle process that keeps a launch running."""

from __future__ import annotations

from typing import Any

from launch.actions import ExecuteProcess

# The standard input stays open without data; a shell starts faster than Python.
_WAIT = "trap 'exit 0' INT TERM; while :; do read -r _ || exit 0; done"


class KeepAliveProc(ExecuteProcess):
    """
    Keeps a launch going, whatever its other processes do, until it is shut down.

    Parameters
    ----------
    **kwargs
        The arguments of `ExecuteProcess`, except `cmd`.

    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(cmd=['sh', '-c', _WAIT], **{'name': 'keep_alive', **kwargs})
