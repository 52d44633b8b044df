# SPDX-License-Identifier: Apache-2.0
"""When states are due, and what the log says about joints; without ROS."""

from __future__ import annotations

import pytest
from robot_state_publisher.moving_links import UnusableStateError, usable_positions
from robot_state_publisher.node_arguments import unknown_parameters
from robot_state_publisher.published_robot import PublishTimes
from robot_state_publisher.state_watch import StateWatch
from urdf import parse_urdf

MS = 1_000_000
HAND = parse_urdf(
    '<robot name="hand"><link name="palm"/>'
    + ''.join(
        f'<link name="{name}"/><joint name="{name}" type="continuous"><parent link="palm"/>'
        f'<child link="{name}"/>{mimic}</joint>'
        for name, mimic in (
            ('left_thumb', ''),
            ('right_thumb', '<mimic joint="left_thumb"/>'),
            ('index', ''),
        )
    )
    + '</robot>'
)


def published(times: PublishTimes, names: list[str], stamps_ms: list[int]) -> list[int]:
    """Return which stamps are published."""
    due = []
    for stamp_ms in stamps_ms:
        if times.is_due(names, stamp_ms * MS):
            times.note(names, stamp_ms * MS)
            due.append(stamp_ms)
    return due


def test_uneven_source_of_that_very_frequency_loses_nothing() -> None:
    """Stamps that are a little early are due too."""
    stamps_ms = [50, 96, 148, 195, 246]
    assert published(PublishTimes(20.0), ['a'], stamps_ms) == stamps_ms


def test_faster_source_is_thinned_out() -> None:
    """The frequency is not exceeded."""
    assert published(PublishTimes(20.0), ['a'], list(range(100, 200, 10))) == [100, 150]


def test_sources_do_not_hold_up_each_other() -> None:
    """A source is due if one of its joints is."""
    times = PublishTimes(20.0)
    assert published(times, ['a'], [100]) == [100]
    assert published(times, ['b'], [110]) == [110]
    assert published(times, ['a', 'b'], [149, 150]) == [149]
    assert published(times, ['a', 'c'], [151]) == [151]


def test_small_disorder_is_no_jump() -> None:
    """Only a stamp far before the last one is a new beginning."""
    times = PublishTimes(20.0)
    times.note(['a'], 5000 * MS)
    assert not times.went_back(['a'], 4500 * MS)
    assert times.went_back(['a'], 3000 * MS)
    assert not times.went_back(['b'], 3000 * MS)
    times.forget()
    assert times.is_due(['a'], 3000 * MS)


def test_followers_need_no_state() -> None:
    """A joint that mimics another is never missing."""
    watch = StateWatch(HAND)
    assert watch.missing == ['left_thumb', 'index']
    assert list(watch.misspelt(['left_thumb', 'index'])) == []
    assert watch.complaint(1, '/joint_states') is None


def test_complaint_names_joints_and_sources() -> None:
    """The complaint says which joints, and who publishes; relief follows, once."""
    watch = StateWatch(HAND)
    list(watch.misspelt(['index']))
    complaint = watch.complaint(2, '/joint_states')
    assert complaint is not None
    assert complaint.startswith('1 of 2 joints has had no state so far')
    assert complaint.endswith("are: 'left_thumb'. /joint_states has 2 publishers.")
    assert watch.relief() is None
    list(watch.misspelt(['left_thumb']))
    assert watch.relief() == 'All 2 joints have a state now.'
    assert watch.relief() is None


def test_texts_on_one_joint_and_on_all() -> None:
    """One joint has, and several have."""
    link = '<link name="palm"/><link name="thumb"/>'
    ends = '<parent link="palm"/><child link="thumb"/>'
    joint = f'<joint name="thumb" type="continuous">{ends}</joint>'
    watch = StateWatch(parse_urdf(f'<robot name="hand">{link}{joint}</robot>'))
    assert str(watch.complaint(0, '/joint_states')).startswith('The only joint has had no state')
    list(watch.misspelt(['thumb']))
    assert watch.relief() == 'The only joint has a state now.'
    assert str(StateWatch(HAND).complaint(0, '/js')).startswith('All 2 joints have had no state')


def test_unknown_positions_are_told_once_a_joint() -> None:
    """Whoever sends no number is told what comes of it; other robots' joints do not matter."""
    watch = StateWatch(HAND)
    assert list(watch.unknown(['index', 'wheel'])) == [
        "The position of joint 'index' in a joint state is not a number, which means that it is "
        'unknown: the joint keeps its last pose.'
    ]
    assert len(list(watch.unknown(['index', 'left_thumb']))) == 1
    assert watch.missing == ['left_thumb', 'index']


def test_similar_names_are_reported_once() -> None:
    """A name like a joint's is a mistake; another one may belong to another robot."""
    watch = StateWatch(HAND)
    assert list(watch.misspelt(['lef_thumb', 'wheel'])) == [
        "The joint states name 'lef_thumb', but the robot has no such joint. "
        "Did you mean 'left_thumb'?"
    ]
    assert list(watch.misspelt(['lef_thumb', 'wheel'])) == []


def test_joints_that_have_a_state_are_not_meant() -> None:
    """A joint of another robot may have a similar name, if all of this one are there."""
    watch = StateWatch(HAND)
    assert list(watch.misspelt(['lef_thumb', 'left_thumb'])) == []


def test_values_that_are_no_number_are_left_out() -> None:
    """Only what a source knows counts."""
    names, positions = usable_positions(['a', 'b', 'c'], [1.0, float('nan'), 3.0])
    assert (names, list(positions)) == (('a', 'c'), [1.0, 3.0])


@pytest.mark.parametrize(
    ('positions', 'sentence'),
    [([], 'has no positions'), ([1.0], 'has 2 names but 1 positions')],
)
def test_states_that_contradict_themselves_are_refused(positions, sentence) -> None:
    """Names and positions must be as many."""
    with pytest.raises(UnusableStateError, match=sentence):
        usable_positions(['a', 'b'], positions)


def test_parameters_that_nothing_takes_are_reported() -> None:
    """A misspelt parameter has a suggestion; those of ROS and of joints are known."""
    given = ['rate', 'zeros.knee', 'rates', 'other', 'use_sim_time', 'qos_overrides./tf.depth']
    assert unknown_parameters(given, ['rate'], ('zeros.',)) == [
        "There is no parameter 'rates'. Did you mean 'rate'?",
        "There is no parameter 'other'.",
    ]
