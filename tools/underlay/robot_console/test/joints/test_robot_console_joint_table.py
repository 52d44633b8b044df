# SPDX-License-Identifier: Apache-2.0
"""The table of joints: what it knows, and how it shows it."""

from __future__ import annotations

import math

import pytest
from robot_console.joint_states import JointState, JointStates, TopicWatch
from robot_console.joint_table import JointRow, JointTable, load_level, position_level
from robot_console.panels.joints_panel import notes_html, table_html
from rviz_common.status import Level
from urdf import Joint, Limits, parse_urdf

URDF = """<robot name="r"><link name="base"/><link name="thigh"/><link name="shank"/>
<link name="rail"/>
<joint name="left_hip" type="revolute"><parent link="base"/><child link="thigh"/>
<limit lower="-1" upper="1" velocity="10" effort="60"/></joint>
<joint name="left_knee" type="continuous"><parent link="thigh"/><child link="shank"/>
<limit velocity="0" effort="inf"/></joint>
<joint name="slide" type="prismatic"><parent link="base"/><child link="rail"/>
<limit lower="0" upper="0.5" velocity="1" effort="5"/></joint></robot>"""
HIP = Joint('hip', 'revolute', 'a', 'b', limits=Limits(-1.0, 1.0), max_velocity=10.0)
NAN = math.nan


def table() -> JointTable:
    """Return a table of a robot that is described."""
    table = JointTable()
    table.describe(parse_urdf(URDF))
    return table


def take(states: JointStates, now_s: float = 0.0, **positions: float) -> None:
    """Take the positions of some joints."""
    states.take(list(positions), list(positions.values()), [], [], now_s)


def test_limits_of_joints() -> None:
    """Speed and effort are read of all joints that move; 0 and infinity say that nobody knows."""
    hip, knee, slide = parse_urdf(URDF).joints
    assert (hip.max_velocity, hip.max_effort) == (10.0, 60.0)
    assert (knee.max_velocity, knee.max_effort) == (None, None)
    assert (slide.max_velocity, slide.max_effort) == (1.0, 5.0)


def test_groups() -> None:
    """Joints are grouped by limb, with or without messages; unknown ones come last."""
    joints = table()
    take(joints.measured, left_hip=0.5, wheel=1.0)
    groups = joints.groups(0.1)
    assert [group.title for group in groups][-1] == 'Not in the robot description'
    rows = {row.name: row for group in groups for row in group.rows}
    assert set(rows) == {'left_hip', 'left_knee', 'slide', 'wheel'}
    assert rows['left_hip'].state.position == 0.5
    assert rows['left_knee'].state.position is None and rows['left_knee'].is_stale


def test_without_description() -> None:
    """Joints are there in their alphabetical order before there is a description."""
    joints = JointTable()
    take(joints.measured, b=0.0, a=1.0)
    [group] = joints.groups(0.0)
    assert [row.name for row in group.rows] == ['a', 'b']
    assert '1.000<i>57.3°</i>' in table_html([group])


def test_targets() -> None:
    """A command of the last second is the target; the error is what is left to go."""
    joints = table()
    take(joints.measured, 5.0, left_hip=0.5)
    take(joints.commanded, 5.0, left_hip=0.75)
    [[hip]] = [group.rows for group in joints.groups(5.5, 'hip')]
    assert (hip.target, hip.error) == (0.75, 0.25)
    assert '--p:75%;--t:88%' in table_html(joints.groups(5.5))
    [[hip]] = [group.rows for group in joints.groups(6.5, 'hip')]
    assert (hip.target, hip.error, hip.is_stale) == (None, None, True)
    assert '<tr class=s>' in table_html(joints.groups(6.5))


def test_several_publishers() -> None:
    """Each publisher may know some of the joints."""
    states = JointStates()
    take(states, 1.0, a=1.0)
    take(states, 2.0, b=2.0)
    take(states, 3.0, a=3.0)
    assert {name: (each.position, each.at_s) for name, each in states.states.items()} == {
        'a': (3.0, 3.0),
        'b': (2.0, 2.0),
    }


def test_joints_of_long_ago() -> None:
    """A joint that nobody has said anything about for a minute is forgotten."""
    states = JointStates()
    take(states, 1.0, gone=1.0)
    take(states, 30.0, slow=1.0)
    take(states, 62.0, here=1.0)
    assert set(states.states) == {'slow', 'here'}


@pytest.mark.parametrize(
    ('search', 'names'),
    [
        ('', {'left_hip', 'left_knee', 'slide'}),
        ('KNEE', {'left_knee'}),
        ('left leg', {'left_hip', 'left_knee'}),
        (' hip ', {'left_hip'}),
        ('nobody', set()),
    ],
)
def test_search(search: str, names: set[str]) -> None:
    """Joints are found by parts of their names, and by their limb."""
    groups = table().groups(0.0, search)
    assert {row.name for group in groups for row in group.rows} == names


def test_no_joints() -> None:
    """Without joints there is no table."""
    assert table_html([]) == ''


@pytest.mark.parametrize(
    ('position', 'level'),
    [(0.0, Level.OK), (0.95, Level.WARN), (-0.95, Level.WARN), (1.01, Level.ERROR)],
)
def test_positions_near_limits(position: float, level: Level) -> None:
    """Near its limits a joint is marked, and beyond them more so."""
    assert position_level(JointRow('hip', 'hip', HIP, JointState(position))) is level


@pytest.mark.parametrize(
    ('value', 'maximum', 'level'),
    [
        (8.9, 10.0, Level.OK),
        (-9.1, 10.0, Level.WARN),
        (10.1, 10.0, Level.ERROR),
        (99.0, None, Level.OK),
        (None, 10.0, Level.OK),
    ],
)
def test_loads(value: float | None, maximum: float | None, level: Level) -> None:
    """A velocity or an effort is marked from nine tenths of its maximum on."""
    assert load_level(value, maximum) is level


@pytest.mark.parametrize(
    ('positions', 'complaint'),
    [([1.0], '2 names but 1 positions'), ([], ''), ([NAN, math.inf], '')],
)
def test_malformed_messages(positions: list[float], complaint: str) -> None:
    """What does not fit or is no number is left out, with a sentence if it is a mistake."""
    joints = table()
    joints.measured.take(['left_hip', 'slide'], positions, [], [NAN] * 2, 0.0)
    html = table_html(joints.groups(0.0))
    assert 'nan' not in html and 'inf' not in html
    assert complaint in joints.measured.complaint


def test_good_message_does_not_hide_a_malformed_one() -> None:
    """Of several publishers that are read at once, any may have made a mistake."""
    states = JointStates()
    states.take(['a', 'b'], [1.0], [], [], 1.0)
    take(states, 1.0, c=1.0)
    assert set(states.states) == {'a', 'b', 'c'}
    assert '2 names but 1 positions' in states.complaint
    states.take(['a', 'b'], [1.0, 2.0], [], [], 2.0)
    assert states.states['b'].position == 2.0 and states.complaint == ''


def test_names_are_no_html() -> None:
    """A name cannot bring anything into the page."""
    states = JointTable()
    take(states.measured, **{'<script>': 0.0})
    assert '&lt;script&gt;' in table_html(states.groups(0.0))
    assert '<script>' not in table_html(states.groups(0.0)) + notes_html([('<script>', True)])


def test_many_joints() -> None:
    """The table is limited, and so is what is remembered of a flood of names."""
    joints = JointTable()
    for index in range(3000):
        take(joints.measured, **{f'joint_{index}': 0.0})
    assert '700 more; use the search.' in table_html(joints.groups(0.0))
    assert joints.measured.complaint == 'There are more than 1000 joints.'


def test_what_is_said_of_a_topic() -> None:
    """A topic is said to be late, since when, and who could be asked."""
    states = JointStates()
    watch = TopicWatch('/joint_states', states)
    expected = '/joint_states: Nothing received yet; it has no publisher.'
    assert (watch.is_late(0.0), watch.sentence(0.0, 0)) == (True, expected)
    for tick in range(100):
        take(states, tick / 50, knee=0.0)
    assert watch.sentence(2.0, 1) == '/joint_states: 1 joints, 50 messages per second'
    expected = '/joint_states: Nothing for 3 s; its 2 publishers are silent.'
    assert (watch.is_late(5.0), watch.sentence(5.0, 2)) == (True, expected)
