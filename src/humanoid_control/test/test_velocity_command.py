# SPDX-License-Identifier: Apache-2.0
"""Check velocities and their limits."""

from __future__ import annotations

import math

from humanoid_control.walking.commands import VelocityCommand, VelocityLimits
from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.parameters import WalkParameters
import numpy as np
import pytest

LIMITS = VelocityLimits.of(WalkParameters().velocity)
RANDOM = np.random.default_rng(1)


@pytest.mark.parametrize('bad', [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize('place', [0, 1, 2])
def test_what_is_not_finite_is_refused(bad: float, place: int) -> None:
    """A velocity that is no number is refused, in a sentence that shows it."""
    values = [0.1, 0.2, 0.3]
    values[place] = bad
    with pytest.raises(WalkingError, match=f'{bad:g} .*is not finite'):
        VelocityCommand(*values)


def test_a_small_velocity_stays() -> None:
    """What the gait can do is not changed."""
    command = VelocityCommand(0.2, 0.05, 0.2)
    assert LIMITS.applied(command) == command


@pytest.mark.parametrize(
    ('asked', 'given'),
    [
        (VelocityCommand(9.0), VelocityCommand(LIMITS.forward_m_s)),
        (VelocityCommand(-9.0), VelocityCommand(-LIMITS.backward_m_s)),
        (VelocityCommand(left_m_s=9.0), VelocityCommand(left_m_s=LIMITS.left_m_s)),
        (VelocityCommand(turn_rad_s=-9.0), VelocityCommand(turn_rad_s=-LIMITS.turn_rad_s)),
    ],
)
def test_single_limits(asked: VelocityCommand, given: VelocityCommand) -> None:
    """Each direction ends at its limit."""
    assert LIMITS.applied(asked) == given


def test_velocities_together_keep_their_direction() -> None:
    """However much is asked, the shares of the limits come to no more than they may."""
    for _ in range(200):
        asked = VelocityCommand(*RANDOM.uniform(-1, 1, 3))
        given = LIMITS.applied(asked)
        assert LIMITS.shares(given) <= LIMITS.sum_of_shares + 1e-12
        assert given.forward_m_s * asked.forward_m_s >= 0


def test_change_is_limited_and_arrives() -> None:
    """A velocity goes to its target in even steps, and arrives exactly."""
    most = VelocityCommand(0.1, 0.05, 0.2)
    target = VelocityCommand(0.25, -0.12, 0.3)
    ways = [VelocityCommand()]
    for _ in range(4):
        ways.append(ways[-1].towards(target, most))
    assert ways[1] == VelocityCommand(0.1, -0.05, 0.2)
    assert ways[-1] == target


def test_zero_is_standing() -> None:
    """Only the velocity without any part is standing."""
    assert VelocityCommand().is_zero
    assert VelocityCommand(-0.0, 0.0, 0.0).is_zero
    assert not VelocityCommand(turn_rad_s=1e-6).is_zero
