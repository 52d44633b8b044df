# SPDX-License-Identifier: Apache-2.0
"""Check when the robot must hold still."""

from __future__ import annotations

from humanoid_control.emergency_stop import PRESSED, StopGuard


def checked(guard: StopGuard, from_s: float, to_s: float, step_s: float = 0.02) -> str:
    """Check again and again, and return the last reason."""
    reason = ''
    for step in range(round((to_s - from_s) / step_s) + 1):
        reason = guard.check(from_s + step * step_s)
    return reason


def test_nothing_heard() -> None:
    """Without a stop and without a console the robot moves, however long."""
    assert checked(StopGuard(0.5), 0.0, 20.0) == ''


def test_pressed_and_released() -> None:
    """The emergency stop holds until it is released."""
    guard = StopGuard(0.5)
    guard.order(True)
    assert checked(guard, 0.0, 5.0) == PRESSED == guard.reason
    guard.order(False)
    assert checked(guard, 5.0, 6.0) == ''


def test_console_is_gone() -> None:
    """A console in control that is silent for the timeout stops the robot, not earlier."""
    guard = StopGuard(0.5)
    guard.check(0.0)
    guard.heartbeat(True)
    assert checked(guard, 0.0, 0.46) == ''
    assert 'is lost, with no heartbeat for 0.5 s' in checked(guard, 0.48, 0.54)


def test_heartbeats_keep_the_robot_moving() -> None:
    """With a heartbeat now and then the robot moves."""
    guard = StopGuard(0.5)
    for beat in range(50):
        guard.heartbeat(True)
        assert checked(guard, beat * 0.4, beat * 0.4 + 0.38) == ''


def test_new_heartbeats_do_not_release() -> None:
    """A console that comes back does not move the robot: a person has to release it."""
    guard = StopGuard(0.5)
    guard.heartbeat(True)
    assert checked(guard, 0.0, 1.0)
    guard.heartbeat(True)
    assert checked(guard, 1.0, 1.2)
    guard.order(False)
    assert checked(guard, 1.2, 1.3) == ''
    assert checked(guard, 1.3, 2.0), 'the console in control is watched again'


def test_control_given_back() -> None:
    """A console that gives control back may go."""
    guard = StopGuard(0.5)
    guard.heartbeat(True)
    guard.heartbeat(False)
    assert checked(guard, 0.0, 5.0) == ''


def test_release_does_not_forget_who_is_in_control() -> None:
    """A stop that is pressed and released leaves the console in control watched."""
    guard = StopGuard(0.5)
    guard.heartbeat(True)
    guard.order(True)
    guard.order(False)
    assert checked(guard, 0.0, 1.0)


def test_own_pause() -> None:
    """When this computer stood still, waiting heartbeats are heard before a verdict."""
    guard = StopGuard(0.5)
    guard.check(0.0)
    guard.heartbeat(True)
    assert guard.check(3.0) == ''
    guard.heartbeat(True)
    assert guard.check(3.02) == ''


def test_first_reason_stays() -> None:
    """A stop that is pressed stays the reason when the console goes as well."""
    guard = StopGuard(0.5)
    guard.heartbeat(True)
    guard.order(True)
    assert checked(guard, 0.0, 2.0) == PRESSED
