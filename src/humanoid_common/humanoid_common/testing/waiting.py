# SPDX-License-Identifier: Apache-2.0
"""Wait for a condition instead of sleeping."""

from __future__ import annotations

from collections.abc import Callable
import time


class WaitedInVainError(AssertionError):
    """A condition did not come true in time, which fails the test."""


def wait_until(
    predicate: Callable[[], bool],
    timeout_s: float = 60.0,
    message: Callable[[], str] = lambda: 'the condition',
    pause: Callable[[], None] = lambda: time.sleep(0.01),
) -> None:
    """
    Return as soon as the predicate holds, or raise WaitedInVainError with the message.

    `pause` runs between two attempts: a place to spin an executor.
    """
    deadline_s = time.monotonic() + timeout_s
    while not predicate():
        if time.monotonic() > deadline_s:
            raise WaitedInVainError(f'Waited {timeout_s} s in vain for {message()}')
        pause()
