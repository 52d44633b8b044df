# SPDX-License-Identifier: Apache-2.0
"""Check the motion of the joints."""

from __future__ import annotations

import math

from humanoid_control.joint_controller_parameters import JointControllerParameters
from humanoid_control.sine_motion import motion_of, Swing
import pytest

TIMES_S = [0.0, 0.1, 1.0, 2.5, 100.0]
SWING = Swing('elbow', 0.8, 1.5, 0.3)


@pytest.mark.parametrize('now_s', TIMES_S)
def test_default_positions(now_s: float) -> None:
    """The left arm follows the sines of the book, the right one half a period later."""
    positions = JointControllerParameters().motion.positions_rad(now_s)
    left = [0.5 * math.sin(now_s), 0.8 * math.sin(1.5 * now_s)]
    assert positions == pytest.approx([*left, -left[0], -left[1]], abs=1e-9)


@pytest.mark.parametrize('now_s', TIMES_S)
def test_velocity_is_the_derivative(now_s: float) -> None:
    """The velocity is the slope of the position."""
    step_s = 1e-6
    slope = (SWING.position_rad(now_s + step_s) - SWING.position_rad(now_s - step_s)) / 2e-6
    assert SWING.velocity_rad_s(now_s) == pytest.approx(slope, abs=1e-6)


def test_frequency_changes_without_a_jump() -> None:
    """With a new frequency, a joint goes on from where it is, but faster."""
    now_s = 12.3
    faster = SWING.followed_by(Swing('elbow', 0.8, 3.0, 0.3), now_s)
    assert faster.position_rad(now_s) == pytest.approx(SWING.position_rad(now_s))
    assert faster.velocity_rad_s(now_s) == pytest.approx(2 * SWING.velocity_rad_s(now_s))


def test_phase_changes_by_the_difference() -> None:
    """A new phase turns the joint on by the difference."""
    now_s = 12.3
    shifted = SWING.followed_by(Swing('elbow', 0.8, 1.5, 0.3 + math.pi), now_s)
    assert shifted.position_rad(now_s) == pytest.approx(-SWING.position_rad(now_s))


def test_nothing_changes_without_a_change() -> None:
    """Handing over to the same motion leaves all as it is, however often."""
    swing = SWING
    for now_s in (1.0, 2.0, 50.0):
        swing = swing.followed_by(SWING, now_s)
    assert swing.position_rad(60.0) == pytest.approx(SWING.position_rad(60.0))


def test_motion_hands_over_by_name() -> None:
    """Joints that stay go on, whatever their place in the list; new ones join in."""
    old = motion_of(['a', 'b'], [1.0, 1.0], [1.0, 2.0], [0.0, 0.0])
    new = old.followed_by(motion_of(['b', 'c'], [1.0, 1.0], [5.0, 1.0], [0.0, 0.0]), 3.0)
    assert new.joints == ['b', 'c']
    assert new.positions_rad(3.0) == pytest.approx([math.sin(6.0), math.sin(3.0)])
