# SPDX-License-Identifier: Apache-2.0
"""Check when time is said to pass too slowly."""

from __future__ import annotations

from humanoid_control.hosting.slowness import Slowness, Speed

SLOW, FAST = Speed(0.43, 1.0), Speed(0.97, 1.0)


def test_five_seconds_are_too_long() -> None:
    """A moment is forgiven, and what lasts is said, with both factors."""
    slowness = Slowness()
    assert [slowness.complaint(SLOW, now_s) for now_s in (10.0, 12.0, 14.9)] == ['', '', '']
    assert '0.43 instead of 1. The computer is too busy' in slowness.complaint(SLOW, 15.0)
    assert slowness.complaint(FAST, 16.0) == ''
    assert slowness.complaint(SLOW, 17.0) == ''


def test_a_pause_is_not_slow() -> None:
    """Nothing is known in a pause, and the patience begins anew after it."""
    slowness = Slowness()
    slowness.complaint(SLOW, 0.0)
    assert slowness.complaint(None, 4.0) == slowness.complaint(SLOW, 6.0) == ''


def test_what_was_asked_for_is_not_slow() -> None:
    """A tenth of real time may be wanted, and as fast as possible is never too slow."""
    assert not Speed(0.1, 0.1).is_slow and not Speed(0.01, 0.0).is_slow
    assert Speed(3.0, 4.0).is_slow
