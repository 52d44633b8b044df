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
    Wait until a condition holds.

    Parameters
    ----------
    predicate
        The condition.
    timeout_s
        Real time to wait.
    message
        Returns a description of the condition, for the error.
    pause
        Called between two evaluations, for example to spin an executor.

    Raises
    ------
    WaitedInVainError
        The condition did not come true in time.

    """
    deadline_s = time.monotonic() + timeout_s
    while not predicate():
        if time.monotonic() > deadline_s:
            raise WaitedInVainError(f'Timed out after {timeout_s} s waiting for {message()}')
        pause()
