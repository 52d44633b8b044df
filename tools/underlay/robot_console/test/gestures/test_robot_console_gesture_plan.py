# SPDX-License-Identifier: Apache-2.0
"""A gesture begins where the robot is, and stays within the limits of its joints."""

from __future__ import annotations

from dataclasses import replace

import pytest
from robot_console.gestures.gesture_file import BodyPose, Gesture, GestureError, saved_pose, Step
from robot_console.gestures.gesture_plan import common_prefix, plan_gesture, RobotState
from urdf import Joint, Limits


def joint(name: str, max_velocity: float | None = 2.0) -> Joint:
    """Return a joint with limits."""
    return Joint(name, 'revolute', 'a', 'b', limits=Limits(-2.0, 2.0), max_velocity=max_velocity)


JOINTS = {name: joint(name) for name in ('shoulder', 'elbow', 'head', 'knee')}
ROBOT = RobotState(
    JOINTS,
    {'arm': ('shoulder', 'elbow'), 'neck': ('head',)},
    {'shoulder': 0.5, 'elbow': -0.2, 'head': 0.0},
)
UP = Step(1.0, {'shoulder': 1.0})


def test_joints_that_are_not_named_stay() -> None:
    """Each goal has all joints of its controller; a controller without such joints has none."""
    plan = plan_gesture(Gesture('up', (UP, Step(0.5))), ROBOT, 1.0)
    [motion] = plan.motions
    assert (motion.controller, motion.joints) == ('arm', ('shoulder', 'elbow'))
    assert motion.points == ((1.0, (1.0, -0.2)), (1.5, (1.0, -0.2)))
    assert plan.duration_s == 1.5


@pytest.mark.parametrize(('max_velocity', 'takes_s'), [(1.0, 3.75), (9.0, 1.875)])
def test_a_step_takes_as_long_as_its_joints_need(max_velocity: float, takes_s: float) -> None:
    """From rest to rest, a joint is at most 1.5 times as fast as on average."""
    plan = plan_gesture(Gesture('far', (Step(0.1, {'shoulder': -2.0}), UP)), ROBOT, max_velocity)
    assert plan.motions[0].points[0][0] == pytest.approx(takes_s)
    assert plan.duration_s == pytest.approx(takes_s + 1.5 * 3.0 / min(max_velocity, 2.0))


def test_body_poses_begin_with_their_steps() -> None:
    """Also without any joint; controllers that move in the same gesture share its times."""
    bow = BodyPose(0.4)
    steps = (UP, Step(2.0, {'head': 0.1}, bow), Step(1.0, body=BodyPose()))
    plan = plan_gesture(Gesture('bow', steps), ROBOT, 9.0)
    assert plan.body == ((1.0, bow), (3.0, BodyPose()))
    assert [each.controller for each in plan.motions] == ['neck', 'arm']
    assert {tuple(time_s for time_s, _ in each.points) for each in plan.motions} == {(1, 3, 4)}
    assert plan_gesture(Gesture('bow', steps[2:]), ROBOT, 9.0).motions == ()


@pytest.mark.parametrize(
    ('joints', 'said'),
    [
        ({'shuolder': 0.0}, "no joint 'shuolder'. Did you mean 'shoulder'?"),
        ({'knee': 0.0}, "No active controller moves 'knee'."),
        ({'shoulder': 2.1}, "'shoulder' would have to go to 2.1, but its range is from -2 to 2."),
    ],
)
def test_impossible(joints: dict[str, float], said: str) -> None:
    """What a robot cannot do is said in a sentence."""
    with pytest.raises(GestureError) as caught:
        plan_gesture(Gesture('x', (Step(1.0, joints),)), ROBOT, 1.0)
    assert said in str(caught.value)


def test_unknown_position() -> None:
    """A joint whose position is not known is not moved, and neither is one beside it."""
    blind = replace(ROBOT, positions={'shoulder': 0.5})
    with pytest.raises(GestureError, match="position of 'elbow' is not known"):
        plan_gesture(Gesture('up', (UP,)), blind, 1.0)


def test_optional_joints() -> None:
    """A robot without them makes the rest of the gesture; a saved pose has no others."""
    gesture = Gesture('x', (Step(1.0, {'shoulder': 1.0, 'wrist': 0.0}),), '', frozenset({'wrist'}))
    assert plan_gesture(gesture, ROBOT, 1.0).motions[0].points[0][1] == (1.0, -0.2)
    pose = saved_pose('sit', {'knee': 1.0, 'head': 0.2})
    assert [each.controller for each in plan_gesture(pose, ROBOT, 1.0).motions] == ['neck']
    with pytest.raises(GestureError, match='No active controller moves any of its joints'):
        plan_gesture(saved_pose('sit', {'knee': 1.0}), ROBOT, 1.0)


def test_a_joint_that_sags_beyond_its_limit_is_held_at_it() -> None:
    """A controller would refuse the goal otherwise."""
    sagging = replace(ROBOT, positions={'shoulder': 0.5, 'elbow': -2.01})
    assert plan_gesture(Gesture('up', (UP,)), sagging, 1.0).motions[0].points[0][1][1] == -2.0


@pytest.mark.parametrize(
    ('joints', 'prefix'),
    [
        (('shoulder', 'elbow'), ''),
        (('r1_shoulder', 'r1_elbow', 'head'), 'r1_'),
        (('left_shoulder',), 'left_'),
        (('hip',), ''),
    ],
)
def test_prefix(joints: tuple[str, ...], prefix: str) -> None:
    """A robot whose joints all have a prefix makes the same gestures."""
    assert common_prefix(('shoulder', 'elbow'), joints) == prefix
    assert common_prefix((), joints) == ''
