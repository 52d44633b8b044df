# SPDX-License-Identifier: Apache-2.0
"""Terminate the processes that are left in the group of a process after its exit."""

from __future__ import annotations

import asyncio
import signal

from launch._supervision.process_group import is_empty, send_signal

_STEPS = ((signal.SIGINT, 0.5), (signal.SIGTERM, 1.0), (signal.SIGKILL, 1.0))
_LOOK_EVERY_S = 0.02


async def end_leftovers(group: int, *, was_interrupted: bool) -> None:
    """
    Terminate a process group whose leader has exited, with SIGINT, SIGTERM and SIGKILL.

    Parameters
    ----------
    group
        The id of the group.
    was_interrupted
        Whether the group has already received SIGINT; it is not sent again.

    """
    for number, patience_s in _STEPS:
        if is_empty(group):
            return
        if number != signal.SIGINT or not was_interrupted:
            send_signal(group, number)
        await _wait_until_empty(group, patience_s)


async def _wait_until_empty(group: int, patience_s: float) -> None:
    loop = asyncio.get_running_loop()
    end = loop.time() + patience_s
    while loop.time() < end and not is_empty(group):
        await asyncio.sleep(_LOOK_EVERY_S)
