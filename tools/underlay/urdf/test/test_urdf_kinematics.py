# SPDX-License-Identifier: Apache-2.0
"""Positions of joints from poses, and masses of links."""

from __future__ import annotations

import math

import pytest
from urdf import Joint, Limits, Origin, parse_urdf, UrdfError
from urdf.kinematics import joint_motion, joint_position

ORIGIN = Origin((0.1, -0.2, 0.3), (0.4, -0.5, 2.0))
AXIS = (0.6, 0.0, 0.8)

LINK = '<robot name="r"><link name="base">{}</link></robot>'


@pytest.mark.parametrize('kind', ['revolute', 'continuous', 'prismatic'])
@pytest.mark.parametrize('position', [-3.0, -0.2, 0.0, 1.3, 3.1])
def test_positions_are_the_inverse_of_motions(kind: str, position: float) -> None:
    """The pose that a position leads to leads back to the position."""
    joint = Joint('j', kind, 'a', 'b', ORIGIN, AXIS)
    pose = joint_motion(joint)(position)
    assert joint_position(joint, pose) == pytest.approx(position)
    same = (*pose[:3], *(-part for part in pose[3:]))
    assert joint_position(joint, same) == pytest.approx(position)  # type: ignore[arg-type]


@pytest.mark.parametrize(('position', 'found'), [(4.0, 4.0), (-0.1, -0.1), (6.5, 6.5 - math.tau)])
def test_angles_are_within_limits_if_a_turn_is(position: float, found: float) -> None:
    """A joint that turns beyond half a turn is not shown on its other side."""
    joint = Joint('j', 'revolute', 'a', 'b', ORIGIN, AXIS, Limits(-0.5, 5.0))
    assert joint_position(joint, joint_motion(joint)(position)) == pytest.approx(found)


@pytest.mark.parametrize(
    ('content', 'mass'),
    [
        ('', None),
        ('<inertial><inertia ixx="1"/></inertial>', None),
        ('<inertial><mass value="2.5"/></inertial>', 2.5),
    ],
)
def test_masses_are_read(content: str, mass: float | None) -> None:
    """A link without an inertial element has no mass."""
    assert parse_urdf(LINK.format(content)).links[0].mass == mass


def test_a_mass_that_is_no_number_is_refused() -> None:
    """The message names the link."""
    with pytest.raises(UrdfError, match="<mass> of link 'base'"):
        parse_urdf(LINK.format('<inertial><mass value="heavy"/></inertial>'))
