# SPDX-License-Identifier: Apache-2.0
"""Check what SIGINT does to a node."""

from __future__ import annotations

import signal

from humanoid_common.interrupts import PatientInterrupt, StopRequest
import pytest


def test_first_interrupt_is_left_to_ros() -> None:
    """The first signal, and its repetition at once, do not raise."""
    times = iter([10.0, 10.5])
    interrupt = PatientInterrupt(StopRequest(), 1.0, lambda: next(times))
    for _ in range(2):
        interrupt(signal.SIGINT, None)
    assert next(times, None) is None


def test_late_interrupt_raises() -> None:
    """A further signal to a node that does not end breaks into it."""
    times = iter([10.0, 11.5])
    interrupt = PatientInterrupt(StopRequest(), 1.0, lambda: next(times))
    interrupt(signal.SIGINT, None)
    with pytest.raises(KeyboardInterrupt):
        interrupt(signal.SIGINT, None)


def test_at_once() -> None:
    """What is better broken off is broken off by the first signal."""
    request = StopRequest()
    request.at_once = True
    with pytest.raises(KeyboardInterrupt):
        PatientInterrupt(request)(signal.SIGINT, None)
    assert request.is_made
