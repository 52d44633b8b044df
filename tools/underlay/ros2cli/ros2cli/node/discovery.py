# SPDX-License-Identifier: Apache-2.0
"""
Wait for discovery no longer than the graph needs.

Quiet is measured in looks at the graph and not in seconds, so that a busy machine, on which all
processes are slow, gets more time.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
import time
from typing import NamedTuple

DEFAULT_SPIN_TIME = 0.5
PERIOD_S = 0.02
QUIET_LOOKS = 12
PATIENCE = 8


class Snapshot(NamedTuple):
    """
    What is known about the graph at one moment.

    `is_complete` is False as long as something is known to be missing, and True when all
    participants that exist have been seen; None if there is no way to know.
    """

    content: Hashable
    is_complete: bool | None


def wait_until_stable(
    take: Callable[[], Snapshot],
    spin_time_s: float,
    *,
    is_done: Callable[[], object] = bool,
    now_s: Callable[[], float] = time.monotonic,
    sleep: Callable[[float], None] = time.sleep,
    quiet_looks: int = QUIET_LOOKS,
) -> bool:
    """
    Wait until the graph is complete and quiet for a short while, or `is_done()`.

    If completeness is unknown the wait lasts at least `spin_time_s`. Return False if the
    graph was still not complete after several times as long.
    """
    start = now_s()
    last, unchanged = take(), 0
    while not is_done() and now_s() - start < PATIENCE * spin_time_s:
        if unchanged >= quiet_looks and (
            last.is_complete or _is_over(last, now_s() - start, spin_time_s)
        ):
            break
        sleep(PERIOD_S)
        current = take()
        unchanged = unchanged + 1 if current == last else 0
        last = current
    return bool(is_done()) or last.is_complete is not False


def _is_over(last: Snapshot, elapsed_s: float, spin_time_s: float) -> bool:
    return last.is_complete is None and elapsed_s >= spin_time_s
