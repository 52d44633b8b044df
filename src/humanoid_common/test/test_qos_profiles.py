# SPDX-License-Identifier: Apache-2.0
"""Check the named qualities of service."""

from __future__ import annotations

from humanoid_common import qos
import pytest
from rclpy.qos import DurabilityPolicy, qos_check_compatible, QoSCompatibility, ReliabilityPolicy


@pytest.mark.parametrize(
    ('name', 'depth', 'is_reliable', 'is_latched'),
    [
        ('SENSOR', 5, False, False),
        ('STATE', 10, True, False),
        ('COMMAND', 1, True, False),
        ('LATCHED', 1, True, True),
        ('EVENT', 50, True, False),
    ],
)
def test_profile(name: str, depth: int, is_reliable: bool, is_latched: bool) -> None:
    """Each name stands for one depth, reliability and durability."""
    profile = getattr(qos, name)
    assert profile.depth == depth
    assert (profile.reliability == ReliabilityPolicy.RELIABLE) == is_reliable
    assert (profile.durability == DurabilityPolicy.TRANSIENT_LOCAL) == is_latched


@pytest.mark.parametrize('name', qos.__all__)
def test_same_name_on_both_ends(name: str) -> None:
    """A publisher and a subscriber that use the same name understand each other."""
    profile = getattr(qos, name)
    assert qos_check_compatible(profile, profile)[0] != QoSCompatibility.ERROR
