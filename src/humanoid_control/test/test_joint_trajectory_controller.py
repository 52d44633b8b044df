# SPDX-License-Identifier: Apache-2.0
"""Check how goals of trajectories are followed, watched and ended, and who owns the joints."""

from __future__ import annotations

from collections.abc import Sequence
import math
import random
from typing import Any

from humanoid_control.backends import JointLimits, JointTargets
from humanoid_control.controllers import (
    CommandError,
    ErrorCode,
    follow_mode,
    GoalResult,
    hold_mode,
    JointTolerance,
    TrajectoryPoint,
    TrajectoryRequest,
)
from humanoid_control.controllers.joint_trajectory_controller import limb_controllers
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.mock_backend import MockBackend
from humanoid_control.testing import PERIOD_S
from humanoid_description.drives import Drive
import numpy as np
import pytest

ARM = ('left_shoulder', 'left_elbow')
JOINTS = (*ARM, 'head_yaw', 'left_knee')
VELOCITY_RAD_S = 2.0
DRIVES = {
    name: Drive(
        lower=-2.0,
        upper=1.0,
        effort=20.0,
        velocity=VELOCITY_RAD_S,
        damping=0.2,
        friction=0.1,
        kp=60.0,
        kd=1.8,
        armature=0.01,
    )
    for name in JOINTS
}
LIMITS = JointLimits.of(DRIVES, JOINTS)
NAME = 'left_arm_controller'


class Robot:
    """A robot whose arms are controlled, its time, and all that its joints were told."""

    def __init__(self) -> None:
        """Begin to hold all joints."""
        self.backend = MockBackend(DRIVES, period_s=PERIOD_S)
        modes = [follow_mode(JOINTS), hold_mode(JOINTS)]
        self.control = RobotControl(JOINTS, LIMITS, modes)
        self.told: list[JointTargets] = []
        self.results: list[GoalResult] = []
        self.blocked: float | None = None

    @property
    def arm(self) -> Any:
        """Return the controller of the arm."""
        return self.control.goals.by_name[NAME]

    def run(self, seconds: float) -> None:
        """Let time pass."""
        for _ in range(round(seconds / PERIOD_S)):
            observation = self.backend.observe()['']
            if self.blocked is not None:
                observation.positions_rad[0] = self.blocked
            targets = self.control.update(observation)
            self.told.append(targets)
            self.backend.step({'': targets})

    def send(
        self, *points: tuple[float, Sequence[float]], name: str = NAME, **options: Any
    ) -> list[GoalResult]:
        """Send a goal; return where its end comes."""
        joints = self.control.goals.by_name[name].own
        way = [TrajectoryPoint(time_s, positions) for time_s, positions in points]
        request = TrajectoryRequest(joints, way, **options)
        results: list[GoalResult] = []
        goal = self.control.goals.checked_goal(name, request)
        self.control.goals.by_name[name].accept(goal, results.append)
        return results

    def told_rad(self, joint: str = 'left_shoulder') -> float:
        """Return where a joint was told to be last."""
        return float(self.told[-1].positions_rad[JOINTS.index(joint)])

    def fastest_rad_s(self) -> float:
        """Return the largest change of a target in a period, as a velocity."""
        way = np.array([targets.positions_rad for targets in self.told])
        return float(np.abs(np.diff(way, axis=0)).max() / PERIOD_S)


def test_limbs_of_the_humanoid() -> None:
    """Arms and head have controllers; a limb that is missing, none; a prefix is no matter."""
    controllers = limb_controllers(['left_r_right_elbow', 'left_r_left_knee', 'left_r_head_yaw'])
    assert {each.name: each.own for each in controllers} == {
        'right_arm_controller': ('left_r_right_elbow',),
        'head_controller': ('left_r_head_yaw',),
    }


def test_a_goal_is_reached_and_stays() -> None:
    """The arm goes through the points, says so at the end, and keeps the last pose."""
    robot = Robot()
    robot.run(0.5)
    results = robot.send((1.0, [0.3, -0.4]), (2.0, [0.6, -0.8]))
    robot.run(1.0)
    assert robot.told_rad() == pytest.approx(0.3, abs=0.02) and robot.arm.has_goal
    robot.run(1.1)
    assert [(each.code, each.is_canceled) for each in results] == [(ErrorCode.SUCCESSFUL, False)]
    robot.run(3.0)
    assert robot.told_rad() == pytest.approx(0.6)
    assert robot.told_rad('left_elbow') == pytest.approx(-0.8)
    assert robot.control.manager.claims.claimed() == dict.fromkeys(ARM, NAME)


def test_joints_in_another_order() -> None:
    """A goal may name the joints of a controller in any order."""
    robot = Robot()
    request = TrajectoryRequest(tuple(reversed(ARM)), [TrajectoryPoint(1.0, [-0.5, 0.2])])
    robot.arm.accept(robot.control.goals.checked_goal(NAME, request), robot.results.append)
    robot.run(1.5)
    assert robot.told_rad('left_shoulder') == pytest.approx(0.2)
    assert robot.told_rad('left_elbow') == pytest.approx(-0.5)


def test_progress() -> None:
    """While a goal runs, it is known where the joints should be and where they are."""
    robot = Robot()
    assert robot.arm.progress is None
    robot.send((1.0, [0.5, 0.0]))
    robot.run(0.51)
    progress = robot.arm.progress
    assert progress.time_s == pytest.approx(0.5)
    assert progress.desired_rad == pytest.approx([0.25, 0.0])
    assert progress.actual_rad == pytest.approx(
        robot.backend.observe()[''].positions_rad[:2], abs=0.02
    )
    robot.run(1.0)
    assert robot.arm.progress is None


def test_path_tolerance() -> None:
    """An arm that leaves its path ends the goal, with joint and error, and is held there."""
    robot = Robot()
    robot.blocked = 0.0
    tolerance = [JointTolerance('left_shoulder', 0.1)]
    results = robot.send((1.0, [0.8, 0.0]), path=tolerance)
    robot.run(1.0)
    (result,) = results
    assert result.code == ErrorCode.PATH_TOLERANCE_VIOLATED
    assert "'left_shoulder' is off by 0.1" in result.message
    assert '0.1 rad are tolerated' in result.message
    robot.run(1.0)
    assert robot.told_rad() == pytest.approx(0.0)
    assert robot.fastest_rad_s() <= VELOCITY_RAD_S + 1e-9


def test_velocity_tolerance() -> None:
    """Velocities are watched, too, when they are given."""
    robot = Robot()
    results = robot.send((0.5, [0.9, 0.0]), path=[JointTolerance('left_shoulder', -1.0, 0.01)])
    robot.run(0.6)
    assert results[0].code == ErrorCode.PATH_TOLERANCE_VIOLATED
    assert 'rad/s are tolerated' in results[0].message


def test_goal_tolerance() -> None:
    """A goal that is not reached in its time ends so; without a time, it waits."""
    robot = Robot()
    robot.blocked = 0.0
    goal = [JointTolerance('left_shoulder', 0.05)]
    results = robot.send((1.0, [0.5, 0.0]), goal=goal, goal_time_s=0.5)
    robot.run(1.4)
    assert not results
    robot.run(0.2)
    assert results[0].code == ErrorCode.GOAL_TOLERANCE_VIOLATED
    assert "'left_shoulder' is off by 0.500 rad" in results[0].message
    waiting = robot.send((1.0, [0.5, 0.0]), goal=goal)
    robot.run(10.0)
    assert not waiting and robot.arm.has_goal
    robot.blocked = None
    robot.run(1.0)
    assert waiting[0].code == ErrorCode.SUCCESSFUL


def test_tolerance_erased() -> None:
    """A tolerance of -1 lets a joint be anywhere."""
    robot = Robot()
    robot.blocked = 0.0
    anywhere = [JointTolerance('left_shoulder', -1.0, -1.0)]
    results = robot.send((1.0, [0.5, 0.0]), path=anywhere, goal=anywhere)
    robot.run(1.1)
    assert results[0].code == ErrorCode.SUCCESSFUL


def test_preempted() -> None:
    """A new goal ends the old one and goes on from its position and velocity."""
    robot = Robot()
    first = robot.send((1.0, [0.8, 0.0]))
    robot.run(0.5)
    second = robot.send((1.0, [-0.8, 0.0]))
    assert first[0].code == ErrorCode.INVALID_GOAL and 'newer goal' in first[0].message
    robot.run(1.2)
    assert second[0].code == ErrorCode.SUCCESSFUL
    velocities = np.diff([targets.positions_rad[0] for targets in robot.told]) / PERIOD_S
    assert np.abs(velocities).max() <= VELOCITY_RAD_S + 1e-9
    assert np.abs(np.diff(velocities)).max() < 0.35


def test_cancelled() -> None:
    """A goal that is cancelled leaves the arm where it was told to be then."""
    robot = Robot()
    results = robot.send((1.0, [0.8, 0.0]))
    robot.run(0.5)
    at_rad = robot.told_rad()
    robot.arm.cancel_goal()
    assert results[0].is_canceled
    robot.run(1.0)
    assert robot.told_rad() == pytest.approx(at_rad, abs=0.02)
    robot.run(1.0)
    assert robot.told_rad() == pytest.approx(at_rad, abs=0.02)
    assert robot.control.manager.claims.owner('left_shoulder') == NAME


def test_stop() -> None:
    """A stop aborts the goal and refuses others; after it, the arm stays where it was stopped."""
    robot = Robot()
    results = robot.send((1.0, [0.8, 0.0]))
    robot.run(0.5)
    robot.control.hold_still(True)
    assert results[0].code == ErrorCode.INVALID_GOAL and 'hold still' in results[0].message
    robot.run(1.0)
    at_rad = robot.told_rad()
    with pytest.raises(CommandError, match='hold still'):
        robot.send((1.0, [0.0, 0.0]))
    robot.control.hold_still(False)
    robot.run(1.0)
    assert robot.told_rad() == pytest.approx(at_rad)
    assert robot.control.manager.claims.owner('left_shoulder') == NAME


def test_mode_that_lends_nothing() -> None:
    """When the mode takes its joints, the goal ends; the mode refuses others."""
    robot = Robot()
    results = robot.send((1.0, [0.8, 0.0]))
    robot.run(0.5)
    robot.control.manager.switch('hold')
    robot.run(0.1)
    assert results[0].code == ErrorCode.INVALID_GOAL
    with pytest.raises(CommandError, match="claimed by the mode 'hold'"):
        robot.send((1.0, [0.0, 0.0]))


def test_reset() -> None:
    """A reset ends the goal and gives the joints back."""
    robot = Robot()
    results = robot.send((1.0, [0.8, 0.0]))
    robot.run(0.5)
    robot.control.reset()
    assert 'reset' in results[0].message
    robot.run(0.1)
    assert robot.control.manager.claims.claimed() == {}


def test_others_wait_for_the_controller() -> None:
    """What the controller holds, nobody else moves; the way out is said."""
    robot = Robot()
    robot.send((0.5, [0.2, 0.0]))
    robot.run(1.0)
    for command in (
        lambda: robot.control.follow(['left_elbow'], [0.1]),
        lambda: robot.control.run(['left_elbow'], [TrajectoryPoint(1.0, [0.1])]),
    ):
        with pytest.raises(CommandError, match=f"claimed by '{NAME}'.*deactivate that controller"):
            command()
    robot.control.follow(['head_yaw'], [0.1])


def test_a_goal_takes_joints_from_commands() -> None:
    """Joints that commands move go to the controller smoothly."""
    robot = Robot()
    for _ in range(50):
        robot.control.follow(list(ARM), [0.4, -0.4])
        robot.run(PERIOD_S)
    robot.told.clear()
    robot.send((1.0, [-0.2, 0.2]))
    robot.run(1.2)
    assert robot.told_rad() == pytest.approx(-0.2)
    assert robot.fastest_rad_s() <= VELOCITY_RAD_S + 1e-9


def test_start_later_and_earlier() -> None:
    """A trajectory may start later, or have started: its end is at its time."""
    robot = Robot()
    later = robot.send((0.5, [0.2, 0.0]), start_in_s=1.0)
    robot.run(1.4)
    assert not later
    robot.run(0.2)
    assert later
    earlier = robot.send((1.0, [0.0, 0.0]), (2.0, [0.4, 0.0]), start_in_s=-1.5)
    robot.run(0.6)
    assert earlier[0].code == ErrorCode.SUCCESSFUL
    with pytest.raises(CommandError, match='it ended 3 s ago'):
        robot.send((1.0, [0.0, 0.0]), start_in_s=-4.0)


@pytest.mark.parametrize(
    ('joints', 'points', 'options', 'reason'),
    [
        (['left_shoulder'], [(1.0, [0.0])], {}, "leaves out 'left_elbow'"),
        ([*ARM, 'head_yaw'], [(1.0, [0.0] * 3)], {}, "'head_yaw' is not a joint of"),
        (['left_shoulder', 'left_elbw'], [(1.0, [0.0] * 2)], {}, "Did you mean 'left_elbow'"),
        ([], [(1.0, [])], {}, 'names no joint'),
        (ARM, [], {}, 'has no points'),
        (ARM, [(2.0, [0.0, 0.0]), (1.0, [0.1, 0.1])], {}, 'Times must increase'),
        (ARM, [(1.0, [math.nan, 0.0])], {}, "position of 'left_shoulder' is nan"),
        (ARM, [(1.0, [1.2, 0.0])], {}, 'out of its range'),
        (ARM, [(1.0, [0.0, 0.0]), (1.1, [0.9, 0.0])], {}, 'would have to move at 9 rad/s'),
        (ARM, [(1.0, [0.0, 0.0], [0.5, 0.0])], {}, 'End at rest'),
        (ARM, [(1.0, [0.0, 0.0])], {'goal_time_s': -1.0}, 'goal time tolerance is -1 s'),
        (
            ARM,
            [(1.0, [0.0, 0.0])],
            {'path': [JointTolerance('elbow', 1.0)]},
            "tolerance of 'elbow'",
        ),
        (
            ARM,
            [(1.0, [0.0, 0.0])],
            {'goal': [JointTolerance('left_elbow', math.nan)]},
            "tolerance of the position of 'left_elbow' is nan",
        ),
        (
            ARM,
            [(1.0, [0.0, 0.0])],
            {'path': [JointTolerance('left_elbow', 0.0, -2.0)]},
            "tolerance of the velocity of 'left_elbow' is -2",
        ),
    ],
)
def test_refused(
    joints: Sequence[str],
    points: Sequence[tuple[Any, ...]],
    options: dict[str, Any],
    reason: str,
) -> None:
    """What cannot be done is refused with the reason, and what runs goes on."""
    robot = Robot()
    running = robot.send((1.0, [0.5, 0.0]))
    robot.run(0.5)
    request = TrajectoryRequest(joints, [TrajectoryPoint(*point) for point in points], **options)
    with pytest.raises(CommandError) as refusal:
        robot.control.goals.checked_goal(NAME, request)
    assert reason in str(refusal.value)
    robot.run(0.6)
    assert running[0].code == ErrorCode.SUCCESSFUL
    assert robot.told_rad() == pytest.approx(0.5)


def test_a_hundred_goals_at_random() -> None:
    """Goals sent, cancelled and preempted at random: each ends once, and nothing jumps."""
    robot, chance = Robot(), random.Random(4)
    sent: list[list[GoalResult]] = []
    for _ in range(100):
        name = chance.choice(list(robot.control.goals.by_name))
        count = len(robot.control.goals.by_name[name].own)
        way = [
            (0.6 * (1 + k), [chance.uniform(-0.5, 0.5) for _ in range(count)]) for k in range(2)
        ]
        sent.append(robot.send(*way, name=name))
        robot.run(chance.choice([0.0, 0.01, 0.1, 0.7, 1.5]))
        if chance.random() < 0.4:
            robot.control.goals.by_name[name].cancel_goal()
            robot.run(chance.choice([0.0, 0.05]))
    robot.run(2.0)
    assert all(len(results) == 1 for results in sent)
    ends = {results[0].code for results in sent}, {results[0].is_canceled for results in sent}
    assert ends == ({ErrorCode.SUCCESSFUL, ErrorCode.INVALID_GOAL}, {True, False})
    assert robot.fastest_rad_s() <= VELOCITY_RAD_S + 1e-9
    owners = {joint: robot.control.manager.claims.owner(joint) for joint in JOINTS}
    assert owners == {
        'left_shoulder': NAME,
        'left_elbow': NAME,
        'head_yaw': 'head_controller',
        'left_knee': 'follow',
    }
