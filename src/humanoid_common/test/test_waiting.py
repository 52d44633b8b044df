# SPDX-License-Identifier: Apache-2.0
"""Check how tests wait."""

from __future__ import annotations

from humanoid_common.testing.waiting import wait_until, WaitedInVainError
import pytest


def test_ends_when_the_condition_holds() -> None:
    """Waiting ends with the first attempt that succeeds."""
    attempts = iter([False, False, True])
    wait_until(lambda: next(attempts), pause=lambda: None)
    assert list(attempts) == []


def test_failure_says_what_was_missing() -> None:
    """A wait in vain tells what for."""
    with pytest.raises(WaitedInVainError, match='Timed out after .* s waiting for the robot'):
        wait_until(lambda: False, 0.01, lambda: 'the robot')
