# SPDX-License-Identifier: Apache-2.0
"""Check how commands from outside are followed."""

from __future__ import annotations

from humanoid_control.controllers import Follower, JointNames
from humanoid_control.testing import JOINTS, observed

NAMES = JointNames(JOINTS)


def test_wants_what_was_commanded() -> None:
    """It wants the joints of the commands until they are silent for the timeout."""
    follower = Follower(JOINTS)
    assert not follower.wanted(0.0).any()
    follower.accept(NAMES.targets(['right_elbow'], [0.4], [1.0]))
    assert follower.wanted(1.0).tolist() == [False, True, False]
    told = follower.update(observed(1.0))
    assert told.positions_rad[1] == 0.4 and told.velocities_rad_s[1] == 1.0
    assert follower.wanted(1.49).any() and not follower.wanted(1.5).any()


def test_two_commanders() -> None:
    """Those who command different joints are heard side by side, each for its own time."""
    follower = Follower(JOINTS)
    follower.accept(NAMES.targets(['left_elbow'], [0.1]))
    follower.accept(NAMES.targets(['left_knee'], [0.2]))
    assert follower.wanted(0.0).tolist() == [True, False, True]
    follower.accept(NAMES.targets(['left_knee'], [0.3]))
    assert follower.wanted(0.4).tolist() == [True, False, True]
    assert follower.wanted(0.6).tolist() == [False, False, True]


def test_cancel() -> None:
    """After a cancel it wants nothing."""
    follower = Follower(JOINTS)
    follower.accept(NAMES.targets(['left_elbow'], [0.1]))
    follower.cancel()
    assert not follower.wanted(0.0).any()
