# SPDX-License-Identifier: Apache-2.0
"""Checkers of the goal and of progress, without ROS."""

from dataclasses import fields

from nav2_controller.checkers import (
    PoseProgressChecker,
    PositionGoalChecker,
    SimpleGoalChecker,
    SimpleProgressChecker,
    StoppedGoalChecker,
)
from nav2_controller.control import SpeedLimit, Velocity
from nav2_controller.plugins import PluginContext
from nav2_util.geometry import Pose2D
from nav2_util.parameters import ParameterSet
import pytest

GOAL = Pose2D(2.0, 1.0, 0.5)


class Source:
    """Parameters without a node."""

    def __init__(self, values):
        self.values = values

    def declare(self, kind, prefix=''):
        names = {each.name for each in fields(kind)}
        return ParameterSet(kind(**{k: v for k, v in self.values.items() if k in names}))

    def declare_unsupported(self, names, prefix=''):
        pass


def make(kind, **values):
    return kind(PluginContext(Source(values), 'checker'))


def test_simple_goal_checker_wants_position_and_orientation():
    """Both have to be within their tolerances."""
    checker = make(SimpleGoalChecker)
    assert not checker.is_reached(Pose2D(1.5, 1.0, 0.5), GOAL, Velocity())
    assert not checker.is_reached(Pose2D(1.9, 1.0, 1.5), GOAL, Velocity())
    assert checker.is_reached(Pose2D(1.9, 1.0, 0.6), GOAL, Velocity())
    assert checker.tolerances() == (0.25, 0.25)


def test_stateful_checker_remembers_the_position():
    """A robot that drifts while it turns has still reached the goal, until a new one."""
    drifted = Pose2D(1.7, 1.0, 0.5)
    for stateful in (True, False):
        checker = make(SimpleGoalChecker, stateful=stateful)
        checker.is_reached(Pose2D(2.0, 1.0, 2.0), GOAL, Velocity())
        assert checker.is_reached(drifted, GOAL, Velocity()) is stateful
        checker.reset()
        assert not checker.is_reached(drifted, GOAL, Velocity())


def test_stopped_goal_checker_waits_until_the_robot_stands():
    """Speed and angular velocity have to be low."""
    checker = make(StoppedGoalChecker, trans_stopped_velocity=0.1, rot_stopped_velocity=0.1)
    assert not checker.is_reached(GOAL, GOAL, Velocity(0.1, 0.1, 0.0))
    assert not checker.is_reached(GOAL, GOAL, Velocity(0.0, 0.0, -0.2))
    assert checker.is_reached(GOAL, GOAL, Velocity(0.05, 0.0, 0.05))


def test_position_goal_checker_ignores_the_orientation():
    """Any orientation will do."""
    assert make(PositionGoalChecker).is_reached(Pose2D(2.1, 1.0, -2.0), GOAL, Velocity())


def test_simple_progress_checker_wants_motion():
    """Turning is no progress; moving far enough gives new time."""
    checker = make(
        SimpleProgressChecker, required_movement_radius=0.5, movement_time_allowance=2.0
    )
    assert checker.check(Pose2D(0.0, 0.0, 0.0), 10.0)
    assert checker.check(Pose2D(0.6, 0.0, 0.0), 11.9)
    assert checker.check(Pose2D(0.6, 0.3, 3.0), 13.9)
    assert not checker.check(Pose2D(0.6, 0.3, 0.0), 14.0)
    assert '0.5 m within 2 s' in checker.reason()
    checker.reset()
    assert checker.check(Pose2D(0.6, 0.3, 0.0), 14.1)


def test_pose_progress_checker_counts_turning():
    """A turn by the angle is progress."""
    checker = make(PoseProgressChecker, movement_time_allowance=2.0)
    assert checker.check(Pose2D(0.0, 0.0, 3.0), 0.0)
    assert checker.check(Pose2D(0.0, 0.0, -2.7), 1.9)
    assert checker.check(Pose2D(0.0, 0.0, -2.7), 3.8)
    assert not checker.check(Pose2D(0.0, 0.0, -2.7), 4.0)


def test_time_that_jumps_back_starts_anew():
    """A simulator that was reset does not end the goal."""
    checker = make(SimpleProgressChecker)
    assert checker.check(GOAL, 100.0)
    assert checker.check(GOAL, 0.0)
    assert checker.check(GOAL, 9.0)


@pytest.mark.parametrize(
    ('limit', 'ratio'),
    [(SpeedLimit(50.0, True), 0.5), (SpeedLimit(0.1, False), 0.25), (SpeedLimit(9.0, False), 1.0)],
)
def test_speed_limit(limit, ratio):
    """A limit is a part of the configured speed, and never raises it."""
    assert limit.ratio(0.4) == pytest.approx(ratio)
