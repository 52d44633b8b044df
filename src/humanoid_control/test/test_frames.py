# SPDX-License-Identifier: Apache-2.0
"""Check frames and motions that are seen from each other."""

from __future__ import annotations

from humanoid_control.dynamics import Frame, Twist
from humanoid_description.rotations import exp, from_rpy, log
import numpy as np
import pytest

BASE = Frame(np.array([1.0, 2.0, 3.0]), from_rpy(0.3, -0.5, 2.0))
BASE_TWIST = Twist(np.array([0.3, -0.2, 0.1]), np.array([1.0, -0.5, 0.7]))
FOOT = Frame(np.array([1.2, 1.7, 2.2]), from_rpy(-0.2, 0.4, 1.0))
FOOT_TWIST = Twist(np.array([-0.6, 0.4, 0.9]), np.array([-0.4, 0.8, 0.3]))
STEP_S = 1e-6


def after(frame: Frame, twist: Twist, time_s: float) -> Frame:
    """Return where a frame is after it moved evenly."""
    turned = exp(twist.angular_rad_s * time_s) @ frame.rotation
    return Frame(frame.position_m + twist.linear_m_s * time_s, turned)


def test_frame_seen_from_another() -> None:
    """A point of the frame is the same point, whoever looks at it."""
    seen, point = FOOT.seen_from(BASE), np.array([0.4, 0.5, 0.6])
    in_base = seen.position_m + seen.rotation @ point
    in_world = FOOT.position_m + FOOT.rotation @ point
    assert BASE.position_m + BASE.rotation @ in_base == pytest.approx(in_world)


def test_frame_seen_from_itself() -> None:
    """A frame is where it is, and not turned."""
    seen = FOOT.seen_from(FOOT)
    assert seen.position_m == pytest.approx(np.zeros(3))
    assert seen.rotation == pytest.approx(np.eye(3))


def test_twist_is_the_derivative() -> None:
    """The motion that is seen is the change of the frame that is seen."""
    twist = FOOT_TWIST.seen_from(BASE, BASE_TWIST, FOOT.position_m)
    earlier, later = (
        after(FOOT, FOOT_TWIST, t).seen_from(after(BASE, BASE_TWIST, t)) for t in (-STEP_S, STEP_S)
    )
    linear = (later.position_m - earlier.position_m) / (2 * STEP_S)
    angular = log(later.rotation @ earlier.rotation.T) / (2 * STEP_S)
    assert twist.linear_m_s == pytest.approx(linear, abs=1e-8)
    assert twist.angular_rad_s == pytest.approx(angular, abs=1e-8)
