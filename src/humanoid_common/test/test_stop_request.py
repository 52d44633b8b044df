# SPDX-License-Identifier: Apache-2.0
"""Check the request to stop."""

from __future__ import annotations

from humanoid_common.interrupts import StopRequest


def test_request_wakes() -> None:
    """Making the request wakes whoever waits."""
    calls: list[str] = []
    request = StopRequest()
    request.wake_with(lambda: calls.append('woken'))
    assert not request.is_made and calls == []
    request.make()
    assert request.is_made and calls == ['woken']


def test_early_request_is_not_lost() -> None:
    """A request that was made before somebody waits wakes at once."""
    calls: list[str] = []
    request = StopRequest()
    request.make()
    request.wake_with(lambda: calls.append('woken'))
    assert calls == ['woken']


def test_nobody_is_woken_any_more() -> None:
    """Once there is nobody to wake, the request is only noted."""
    calls: list[str] = []
    request = StopRequest()
    request.wake_with(lambda: calls.append('woken'))
    request.wake_with(None)
    request.make()
    assert request.is_made and calls == []
