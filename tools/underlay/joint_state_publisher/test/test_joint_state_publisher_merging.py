# SPDX-License-Identifier: Apache-2.0
"""How defaults, sources and followers become one joint state; without ROS."""

from __future__ import annotations

from math import nan, pi
from typing import Any

from joint_state_publisher.merged_joints import FreeJoint, MergedJoints, States
from joint_state_publisher.settings import Settings
import pytest
from urdf import Mimic, parse_urdf

LIMITS = '<limit lower="-1" upper="2"/><safety_controller soft_upper_limit="1"/>'
HIGH = '<limit lower="1" upper="3"/>'
KINDS = {
    'knee': ('revolute', LIMITS),
    'wheel': ('continuous', ''),
    'lift': ('prismatic', HIGH),
    'shin': ('revolute', '<limit/><mimic joint="knee" multiplier="2" offset="0.5"/>'),
    'toe': ('revolute', '<limit/><mimic joint="shin" multiplier="-1"/>'),
    'glue': ('fixed', ''),
    'cloud': ('floating', ''),
}
LEG = (
    '<link name="root"/><link name="leg"/><joint name="hip" type="revolute">',
    '<parent link="root"/><child link="leg"/>',
)
MODEL = parse_urdf(
    '<robot name="r"><link name="root"/>'
    + ''.join(
        f'<link name="{name}"/><joint name="{name}" type="{kind}"><parent link="root"/>'
        f'<child link="{name}"/>{more}</joint>'
        for name, (kind, more) in KINDS.items()
    )
    + '</robot>'
)


def merged(**settings: Any) -> MergedJoints:
    """Return the joints of the robot."""
    return MergedJoints(MODEL, Settings(**settings))


def positions(joints: MergedJoints) -> dict[str, float]:
    """Return the positions by joint."""
    states = joints.states()
    return dict(zip(states.name, states.position))


def test_default_is_zero_or_the_middle() -> None:
    """A joint that cannot go to 0 begins in the middle; followers follow, fixed ones are out."""
    joints = merged()
    assert positions(joints) == {'knee': 0, 'wheel': 0, 'lift': 2, 'shin': 0.5, 'toe': -0.5}
    assert (joints.states().velocity, joints.states().effort) == ([], [])


def test_zeros_replace_defaults() -> None:
    """What `zeros` says is the default, and followers follow it."""
    joints = merged(zeros={'knee': 0.25})
    assert positions(joints)['knee'] == 0.25
    assert positions(joints)['shin'] == 1.0


def test_zeros_of_no_joint_are_reported() -> None:
    """A zero that is not used is said, with a suggestion."""
    settings = Settings(zeros={'kne': 1.0, 'toe': 1.0})
    assert list(MergedJoints(MODEL, settings).surplus_zeros(settings)) == [
        "The parameter 'zeros.kne' is not used: 'kne' is not a moving joint of this robot. "
        "Did you mean 'knee'?",
        "The parameter 'zeros.toe' is not used: 'toe' follows another joint of this robot.",
    ]


def test_sources_are_merged() -> None:
    """The newest value of each joint counts, whoever sent it; followers cannot be set."""
    joints = merged()
    joints.take(States(['knee', 'wheel'], [0.1, 0.2]))
    joints.take(States(['wheel', 'other', 'toe'], [0.3, 9.0, 9.0]))
    assert positions(joints) == pytest.approx(
        {'knee': 0.1, 'wheel': 0.3, 'lift': 2.0, 'shin': 0.7, 'toe': -0.7}
    )


def test_sources_are_not_bound_to_limits() -> None:
    """What a source tells is shown as it is."""
    joints = merged()
    joints.take(States(['knee'], [7.0]))
    assert positions(joints)['knee'] == 7.0


def test_missing_values_stay_as_they_were() -> None:
    """A source without velocities, or with values that are no number, changes nothing there."""
    joints = merged()
    joints.take(States(['knee', 'wheel'], [0.1, 0.2], velocity=[1.0, 2.0], effort=[3.0, nan]))
    joints.take(States(['knee'], [0.4]))
    joints.take(States(['wheel'], [nan]))
    states = joints.states()
    assert positions(joints)['knee'] == 0.4
    assert positions(joints)['wheel'] == 0.2
    assert states.velocity == [1.0, 2.0, 0.0, 2.0, -2.0]
    assert states.effort == [3.0, 0.0, 0.0, 6.0, -6.0]


def test_positions_that_are_no_number_are_named() -> None:
    """Only those of joints that a source can set; velocities may be unknown."""
    states = States(['knee', 'wheel', 'toe', 'other'], [nan, 0.1, nan, nan], velocity=[nan] * 4)
    assert merged().not_finite(states) == ['knee']


def test_source_that_contradicts_itself_changes_nothing() -> None:
    """A message with fewer positions than names is refused as a whole."""
    joints = merged()
    with pytest.raises(ValueError, match='2 names but 1 velocity values'):
        joints.take(States(['knee', 'wheel'], [0.1, 0.2], velocity=[1.0]))
    assert positions(joints)['knee'] == 0.0


def test_only_what_is_known_without_defaults() -> None:
    """Without default positions, a joint is there once a source tells of it."""
    joints = merged(publish_default_positions=False)
    assert joints.states() == States()
    joints.take(States(['knee'], velocity=[0.5]))
    assert joints.states() == States(['knee', 'shin', 'toe'], [], [0.5, 1.0, -1.0], [])


def test_default_velocities_and_efforts() -> None:
    """Velocities and efforts are published on request."""
    joints = merged(publish_default_velocities=True, publish_default_efforts=True)
    assert joints.states().velocity == joints.states().effort == [0.0] * 5
    assert merged(publish_default_velocities=True).states().effort == []
    assert merged(publish_default_efforts=True).states().velocity == []


def test_mimic_tags_can_be_left_out() -> None:
    """Without them, each joint is on its own."""
    joints = merged(use_mimic_tags=False)
    joints.take(States(['toe'], [0.3]))
    assert positions(joints)['toe'] == 0.3
    assert positions(joints)['shin'] == 0.0


def test_dependent_joints_are_above_mimic_tags() -> None:
    """A parameter lets joints follow, also against the URDF."""
    joints = merged(dependent_joints={'toe': Mimic('wheel', 3.0, 1.0), 'other': Mimic('gone')})
    joints.take(States(['wheel'], [2.0]))
    assert positions(joints)['toe'] == 7.0


@pytest.mark.parametrize(
    ('dependents', 'sentence'),
    [
        ({'toe': Mimic('wheal')}, "lets 'toe' follow 'wheal', which is not a moving joint of this "
         "robot. Did you mean 'wheel'?"),
        ({'toe': Mimic('glue')}, "lets 'toe' follow 'glue', which is not a moving joint"),
        ({'knee': Mimic('toe')}, 'follow each other in a loop: shin -> knee -> toe -> shin'),
    ],
)  # fmt: skip
def test_dependent_joints_that_do_not_fit_are_refused(dependents, sentence) -> None:
    """A joint cannot follow what is not there, or itself."""
    with pytest.raises(ValueError) as caught:
        merged(dependent_joints=dependents)
    assert sentence in str(caught.value)


def test_soft_limits_count_if_wanted() -> None:
    """The safety controller narrows the limits."""
    assert merged().free['knee'].upper == 1.0
    assert merged().free['knee'].lower == -1.0
    assert merged(use_smallest_joint_limits=False).free['knee'].upper == 2.0
    lower = LIMITS.replace('soft_upper_limit="1"', 'soft_lower_limit="-0.5"')
    robot = f'<robot name="r">{"".join(LEG)}{lower}</joint></robot>'
    assert MergedJoints(parse_urdf(robot), Settings()).free['hip'].lower == -0.5


@pytest.mark.parametrize(('lower', 'upper', 'zero'), [(-3, -1, -2), (1, 3, 2), (-1, 3, 0)])
def test_middle(lower: float, upper: float, zero: float) -> None:
    """The default is the middle if 0 is beyond either limit."""
    assert FreeJoint(lower, upper, False).zero == zero


def test_joints_move_to_and_fro() -> None:
    """A joint turns round at its limits, and a continuous one goes on at the other end."""
    joint = FreeJoint(-1.0, 1.0, False, position=0.0)
    wheel = FreeJoint(-pi, pi, True, position=3.0)
    places = []
    for _ in range(6):
        joint.move(0.75)
        places.append(joint.position)
    wheel.move(0.25)
    assert places == [0.75, 1.0, 0.25, -0.5, -1.0, -0.25]
    assert wheel.position == -pi
    wheel.move(-0.25)
    assert wheel.position == pi


def test_joints_move_the_other_way_with_a_negative_delta() -> None:
    """It turns round at the lower limit first."""
    joint = FreeJoint(-1.0, 1.0, False, position=0.0)
    places = []
    for _ in range(6):
        joint.move(-0.75)
        places.append(joint.position)
    assert places == [-0.75, -1.0, -0.25, 0.5, 1.0, 0.25]
