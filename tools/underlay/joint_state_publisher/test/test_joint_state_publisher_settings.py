# SPDX-License-Identifier: Apache-2.0
"""What parameters mean, and with which sentence wrong ones are refused."""

from __future__ import annotations

from joint_state_publisher.settings import Settings, settings_of
import pytest
from urdf import Mimic


def test_nothing_given_is_the_default() -> None:
    """Without parameters, positions are published ten times a second."""
    assert settings_of({}) == Settings(rate=10)
    assert settings_of({'source_list': None}).source_list == ()


def test_nested_parameters_are_by_joint() -> None:
    """Zeros and dependent joints belong to joints, whose names may have points."""
    settings = settings_of(
        {
            'rate': 25,
            'source_list': ['a', 'b'],
            'zeros.left.knee': 1,
            'dependent_joints.right.knee.parent': 'left.knee',
            'dependent_joints.right.knee.factor': -2,
            'dependent_joints.hand.parent': 'left.knee',
            'dependent_joints.hand.offset': 0.5,
            'use_sim_time': True,
        }
    )
    assert (settings.rate, settings.source_list) == (25.0, ('a', 'b'))
    assert settings.zeros == {'left.knee': 1.0}
    assert settings.dependent_joints == {
        'right.knee': Mimic('left.knee', -2.0, 0.0),
        'hand': Mimic('left.knee', 1.0, 0.5),
    }


@pytest.mark.parametrize(
    ('values', 'sentence'),
    [
        ({'rate': 0}, "'rate' must be from 0.001 to 1000, not 0."),
        ({'rate': 1e-300}, "'rate' must be from 0.001 to 1000, not 1e-300."),
        ({'rate': 1e12}, "'rate' must be from 0.001 to 1000, not 1e+12."),
        ({'rate': float('nan')}, "'rate' must be a number, not nan."),
        ({'delta': float('inf')}, "'delta' must be a number, not inf."),
        ({'zeros.knee': float('nan')}, "'zeros.knee' must be a number, not nan."),
        ({'source_list': 5}, "'source_list' must be a list of names, not 5."),
        ({'source_list': True}, "'source_list' must be a list of names, not True."),
        ({'rate': 'often'}, "'rate' must be a number, not 'often'."),
        ({'rate': True}, "'rate' must be a number, not True."),
        ({'source_list': 'commands'}, "'source_list' must be a list of names, not 'commands'"),
        ({'source_list': [1]}, "'source_list' must be a list of names"),
        ({'use_mimic_tags': 'no'}, "'use_mimic_tags' must be true or false, not 'no'."),
        ({'robot_description': 7}, "'robot_description' must be a string, not 7."),
        ({'zeros.knee': 'bent'}, "'zeros.knee' must be a number, not 'bent'."),
        (
            {'dependent_joints.a.parnt': 'b'},
            'must end with one of parent, factor, offset. Did you',
        ),
        ({'dependent_joints.a': 'b'}, "'dependent_joints.a' must end with one of parent, factor"),
        ({'dependent_joints.a.factor': 2.0}, "'a' follows no joint: set dependent_joints.a.par"),
        ({'dependent_joints.a.parent': 'a'}, 'follow each other in a loop: a -> a.'),
    ],
)
def test_wrong_values_are_refused(values, sentence) -> None:
    """Each mistake has its sentence."""
    with pytest.raises(ValueError) as caught:
        settings_of(values)
    assert sentence in str(caught.value)
