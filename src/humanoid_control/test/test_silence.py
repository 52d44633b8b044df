# SPDX-License-Identifier: Apache-2.0
"""Check when somebody counts as silent."""

from __future__ import annotations

from humanoid_control.controllers.silence import Silence


def test_robot_time() -> None:
    """Silent at first, and again when nothing was heard for the timeout."""
    silence = Silence(0.5)
    assert silence.lasts(1.0)
    silence.heard()
    assert not silence.lasts(2.0) and not silence.lasts(2.49)
    silence.heard()
    assert not silence.lasts(2.6) and not silence.lasts(3.0)
    assert silence.lasts(3.1) and silence.lasts(3.2)


def test_both_clocks() -> None:
    """Both times must pass: the simulator may run faster than its user, or be paused."""
    clock = [100.0]
    silence = Silence(0.5, lambda: clock[0])
    silence.heard()
    assert not silence.lasts(0.0) and not silence.lasts(5.0)
    clock[0] = 100.6
    assert silence.lasts(5.1)
    silence.heard()
    clock[0] = 200.0
    assert not silence.lasts(5.2)
    assert silence.lasts(5.8)


def test_end() -> None:
    """An end is silence at once."""
    silence = Silence(0.5)
    silence.heard()
    silence.end()
    assert silence.lasts(0.0)
