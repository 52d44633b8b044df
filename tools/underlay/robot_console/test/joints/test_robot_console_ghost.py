# SPDX-License-Identifier: Apache-2.0
"""Where the links of a robot would be if its joints were where they were told to be."""

from __future__ import annotations

import math

import pytest
from robot_console.commanded_joints import CommandedJoints, following_links, Tolerances
from urdf import parse_urdf

URDF = """<robot name="r"><link name="base"/><link name="a"/><link name="b"/><link name="c"/>
<link name="d"/>
<joint name="turn" type="revolute"><parent link="base"/><child link="a"/>
<origin xyz="1 0 0"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="1" effort="1"/>
</joint>
<joint name="same" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<mimic joint="turn" multiplier="-2" offset="0.5"/></joint>
<joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="1 0 0"/>
<limit lower="0" upper="1" velocity="1" effort="1"/></joint>
<joint name="weld" type="fixed"><parent link="c"/><child link="d"/><origin xyz="0 0 2"/></joint>
</robot>"""


@pytest.fixture
def joints() -> CommandedJoints:
    """Return the joints of a robot that was told nothing."""
    return CommandedJoints(parse_urdf(URDF))


def turned(angle: float) -> list[float]:
    """Return a rotation about z."""
    return pytest.approx([math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2)])


def test_nothing_is_told(joints: CommandedJoints) -> None:
    """Without a command there are no poses, not even those of fixed joints."""
    assert joints.poses(0.0) == {}
    assert not joints.is_told(0.0)


def test_poses(joints: CommandedJoints) -> None:
    """A command moves its joints and those that follow them; others are left to the measured."""
    joints.take(['turn'], [0.5], 1.0)
    poses = joints.poses(1.5)
    assert set(poses) == {'turn', 'same', 'weld'}
    assert poses['turn'].position == (1.0, 0.0, 0.0)
    assert list(poses['turn'].wxyz) == turned(0.5)
    assert list(poses['same'].wxyz) == turned(-0.5)
    assert poses['weld'].position == (0.0, 0.0, 2.0)


def test_commands_expire(joints: CommandedJoints) -> None:
    """Each command holds for a second, whoever gave the others."""
    joints.take(['turn'], [0.5], 1.0)
    joints.take(['slide'], [0.25], 1.9)
    assert {'turn', 'slide'} <= set(joints.poses(1.95))
    assert joints.poses(2.5)['slide'].position == (0.25, 0.0, 0.0)
    assert 'turn' not in joints.poses(2.5)
    assert joints.poses(3.0) == {}


def test_malformed_commands(joints: CommandedJoints) -> None:
    """A command that does not fit is refused; what is no number or no joint is left out."""
    with pytest.raises(ValueError, match='2 names but 1 positions'):
        joints.take(['turn', 'slide'], [1.0], 0.0)
    with pytest.raises(ValueError, match='1 names but 0 positions'):
        joints.take(['turn'], [], 0.0)
    joints.take(['turn', 'slide', 'tail'], [math.nan, math.inf, 1.0], 0.0)
    assert joints.poses(0.0) == {}
    assert joints.unknown == ['tail']


ROBOT = parse_urdf(URDF)
NEAR = Tolerances(0.01, 0.03)


def following(
    angle: float,
    tolerances: Tolerances = NEAR,
    before: frozenset[str] = frozenset(),
    unmeasured: str = '',
) -> set[str]:
    """Return the links that follow while one joint was told an angle and all are at zero."""
    joints = CommandedJoints(ROBOT)
    joints.take(['turn', 'slide'], [angle, 0.0], 0.0)
    told = joints.poses(0.0)
    joints.take(['turn'], [0.0], 0.0)
    found = {name: pose for name, pose in joints.poses(0.0).items() if name != unmeasured}
    poses_of = (lambda joint: told.get(joint.name), lambda joint: found.get(joint.name))
    return set(following_links('base', ROBOT.joints, poses_of, tolerances, before))


def test_links_that_follow() -> None:
    """A link follows within both tolerances; the deviations of the joints above it count."""
    assert following(0.0) == {'base', 'a', 'b', 'c', 'd'}
    assert following(0.5) == {'base'}
    # b turns back twice as far as a, and so as far as a in the other direction.
    assert following(0.02) == {'base', 'a', 'b', 'c', 'd'}
    assert following(0.04) == {'base'}


def test_a_turn_moves_what_is_far_away() -> None:
    """A small angle is a large way for a link far from the joint."""
    long = parse_urdf(URDF.replace('<origin xyz="0 0 2"/>', '<origin xyz="2 0 0"/>'))
    told, found = CommandedJoints(long), CommandedJoints(long)
    told.take(['turn', 'slide'], [0.01, 0.0], 0.0)
    found.take(['turn', 'slide'], [0.0, 0.0], 0.0)
    poses_of = tuple(
        lambda joint, poses=each.poses(0.0): poses.get(joint.name) for each in (told, found)
    )
    assert following_links('base', long.joints, poses_of, NEAR) == {'base', 'a', 'b', 'c'}


def test_a_link_at_the_limit_does_not_flicker() -> None:
    """A link that lagged behind has to come closer than one that follows may go away."""
    everything = frozenset({'base', 'a', 'b', 'c', 'd'})
    assert following(0.025) == {'base'}
    assert following(0.025, before=everything) == everything


@pytest.mark.parametrize('tolerances', [Tolerances(0.0, 0.0), Tolerances(0.0, 1.0)])
def test_nothing_follows_without_a_tolerance(tolerances: Tolerances) -> None:
    """A tolerance of zero shows all links, also the root."""
    assert following(0.0, tolerances) == set()


def test_unknown_links_do_not_follow() -> None:
    """A link whose measured pose is unknown does not follow, nor does what is below it."""
    assert following(0.0, unmeasured='same') == {'base', 'a'}
