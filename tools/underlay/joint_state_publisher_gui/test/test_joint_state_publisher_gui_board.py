# SPDX-License-Identifier: Apache-2.0
"""What sliders show and mean, and what is done to all of them."""

from __future__ import annotations

from math import inf, nan, pi
from random import Random
from typing import Any

from joint_state_publisher.merged_joints import MergedJoints, States
from joint_state_publisher.settings import Settings
from joint_state_publisher_gui.board import Board, Scale
import pytest
from urdf import parse_urdf

LIMITS = {
    'left_knee': ('revolute', '<limit lower="-1" upper="2"/>'),
    'wheel': ('continuous', ''),
    'lift': ('prismatic', '<limit lower="1" upper="3"/>'),
    'toe': ('revolute', '<limit/><mimic joint="left_knee" multiplier="2"/>'),
    'free': ('revolute', '<limit lower="-1e16" upper="1e16"/>'),
    'rail': ('prismatic', '<limit lower="-1e308" upper="1e308"/>'),
}


def made(**settings: Any) -> tuple[Board, MergedJoints]:
    """Return the sliders of a robot, and its joints."""
    text = ''.join(
        f'<link name="{name}"/><joint name="{name}" type="{kind}"><parent link="root"/>'
        f'<child link="{name}"/>{more}</joint>'
        for name, (kind, more) in LIMITS.items()
    )
    model = parse_urdf(f'<robot name="r"><link name="root"/>{text}</robot>')
    joints = MergedJoints(model, Settings(**settings))
    return Board(model, joints), joints


def test_a_slider_for_each_joint_that_follows_no_other() -> None:
    """Followers have none; joints without useful limits have a useful slider."""
    board, _ = made()
    assert {name: (s.scale.lower, s.scale.upper) for name, s in board.sliders.items()} == {
        'left_knee': (-1, 2),
        'wheel': (-pi, pi),
        'lift': (1, 3),
        'free': (-pi, pi),
        'rail': (-1, 1),
    }


def test_ends_of_a_slider_mean_the_limits() -> None:
    """Few decimals are shown, but the whole range can be reached, and no more."""
    scale = Scale(-pi, pi)
    assert (scale.ends, scale.decimals) == ((-3.141, 3.141), 3)
    assert (scale.meant(-3.141), scale.meant(3.141), scale.meant(inf)) == (-pi, pi, pi)
    assert (scale.meant(0.125), scale.shown(0.12345), scale.shown(7.0)) == (0.125, 0.123, 3.141)


@pytest.mark.parametrize(
    ('scale', 'ends'),
    [
        (Scale(-1.2, 2.3), (-1.2, 2.3)),
        (Scale(0.0, 0.002, False), (0.0, 0.002)),
        (Scale(0.5, 0.5), (0.5, 0.5)),
        (Scale(0.0, 1e-300), (0.0, 1e-300)),
        (Scale(-5000.0004, 5000.0004), (-5000.0, 5000.0)),
    ],
)
def test_ends_are_within_the_limits(scale, ends) -> None:
    """Also narrow limits, and those that are one, have ends; all positions are shown within."""
    assert scale.ends == ends
    for position in (-1e9, scale.lower, (scale.lower + scale.upper) / 2, scale.upper, 1e9):
        assert ends[0] <= scale.shown(position) <= ends[1]
        assert scale.lower <= scale.meant(scale.shown(position)) <= scale.upper


def test_both_units() -> None:
    """Angles are told in degrees and distances in millimetres, too."""
    assert Scale(-1, 1).in_words(-pi / 4) == '-45°'
    assert Scale(0, 1, False).in_words(0.0123) == '12\u00a0mm'
    assert Scale(-pi / 2, 0.0).describe() == '-1.571 to 0.000 rad (-90° to 0°)'


def test_input_does_not_come_back() -> None:
    """What a person does is published, and no news for the slider that has been moved."""
    board, joints = made()
    knee = board.sliders['left_knee']
    knee.give(0.5)
    assert knee.news() is None
    assert joints.states().position[0] == 0.5


def test_sources_take_over() -> None:
    """What a source tells is news, once; the slider stays within its ends."""
    board, joints = made()
    knee = board.sliders['left_knee']
    joints.take(States(['left_knee'], [0.25]))
    assert (knee.news(), knee.news()) == (0.25, None)
    joints.take(States(['left_knee'], [7.0]))
    assert (knee.news(), knee.position) == (2.0, 7.0)


def test_input_beyond_the_limits_is_put_right() -> None:
    """A number box may give anything: the joint stays within its limits, and the box is told."""
    board, _ = made()
    knee = board.sliders['left_knee']
    knee.give(99.0)
    assert (knee.position, knee.news()) == (2.0, 2.0)
    knee.give(nan)
    knee.give(inf)
    assert knee.position == 2.0


def test_unknown_positions_are_shown_at_their_default() -> None:
    """Without default positions, nothing is published until somebody moves a joint."""
    board, joints = made(publish_default_positions=False, zeros={'left_knee': 0.5})
    assert board.sliders['left_knee'].shown == 0.5
    assert joints.states().name == []
    board.sliders['left_knee'].give(1.0)
    assert joints.states().name == ['left_knee', 'toe']


def test_all_at_once() -> None:
    """Centre is the default, zero as near as possible, and random positions are within limits."""
    board, _ = made(zeros={'left_knee': 0.25})
    board.randomise(Random(1))
    first = board.pose()
    assert all(
        slider.scale.lower <= first[name] <= slider.scale.upper
        for name, slider in board.sliders.items()
    )
    board.centre()
    assert board.pose() == {'left_knee': 0.25, 'wheel': 0, 'lift': 2, 'free': 0, 'rail': 0}
    board.zero()
    assert board.pose() == {'left_knee': 0, 'wheel': 0, 'lift': 1, 'free': 0, 'rail': 0}
    board.randomise(Random(1))
    assert board.pose() == first


def test_poses_are_applied_as_far_as_they_fit() -> None:
    """Joints that are gone, follow others or stop at a limit have a sentence; the others move."""
    board, _ = made()
    sentences = board.apply({'left_kne': 1.0, 'toe': 1.0, 'lift': 9.0, 'wheel': 0.5})
    assert board.pose() == {'left_knee': 0, 'wheel': 0.5, 'lift': 3, 'free': 0, 'rail': 0}
    assert sentences == [
        "'left_kne' is skipped: it is not a moving joint of this robot. Did you mean 'left_knee'?",
        "'toe' is skipped: it follows another joint of this robot.",
        "'lift' stops at its limit: 9 is not within the limits.",
    ]


def test_search() -> None:
    """All words count, also those of the title of the group."""
    board, _ = made()
    assert [limb.joints for limb in board.found(' KNEE left leg')] == [('left_knee',)]
    assert board.found('knee wheel') == []
    assert board.found('') == board.limbs
