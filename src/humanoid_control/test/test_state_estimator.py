# SPDX-License-Identifier: Apache-2.0
"""Check which feet say where the base is."""

from __future__ import annotations

from humanoid_control.walking.odometry import carrying
import pytest


def test_feet_that_carry_are_believed_as_commanded() -> None:
    """With weight on both the shares are those of the command."""
    assert carrying((0.3, 0.7), (0.4, 0.6)) == pytest.approx((0.3, 0.7))
    assert carrying((0.0, 1.0), (0.0, 1.0)) == (0.0, 1.0)


def test_a_foot_without_its_weight_is_not_believed() -> None:
    """A foot that is to carry but hangs in the air may be anywhere."""
    assert carrying((0.4, 0.6), (1.0, 0.0)) == (1.0, 0.0)
    left, right = carrying((0.5, 0.5), (0.9, 0.05))
    assert left > 0.7
    assert left + right == pytest.approx(1.0)


def test_a_robot_in_the_air_goes_by_the_command() -> None:
    """Without any weight there is nothing better; noise of the sensors does not matter."""
    assert carrying((0.2, 0.8), (0.0, -0.01)) == (0.2, 0.8)
