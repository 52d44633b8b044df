# SPDX-License-Identifier: Apache-2.0
"""Check which trajectories are taken, and how they are run."""

from __future__ import annotations

import math
from typing import Any

from humanoid_control.backends import JointTargets
from humanoid_control.controllers import (
    checked_trajectory,
    CommandError,
    JointNames,
    TrajectoryPoint,
    TrajectoryRunner,
)
from humanoid_control.testing import JOINTS, LIMITS, observed, targets
import pytest

NAMES = JointNames(JOINTS)
HELD = targets(0.1, 0.2, 0.3)


def running(names: list[str], *points: TrajectoryPoint, held: JointTargets) -> TrajectoryRunner:
    """Return what runs a trajectory since the time 5 s."""
    runner = TrajectoryRunner(JOINTS)
    runner.accept(checked_trajectory(NAMES, LIMITS, names, points))
    assert runner.waits and runner.wanted(5.0).any()
    runner.start(observed(5.0), held)
    return runner


def test_runs_from_where_the_joint_is() -> None:
    """It goes from the last target through the points, at rest at the end, and then is done."""
    points = TrajectoryPoint(1.0, [0.5]), TrajectoryPoint(2.0, [-0.5])
    runner = running(['right_elbow'], *points, held=HELD)
    way = {time_s: runner.update(observed(5.0 + time_s)).positions_rad[1] for time_s in (0.0,)}
    assert way[0.0] == pytest.approx(0.2)
    assert runner.update(observed(6.0)).positions_rad[1] == pytest.approx(0.5)
    last = runner.update(observed(7.0))
    assert last.positions_rad[1] == pytest.approx(-0.5)
    assert last.velocities_rad_s[1] == pytest.approx(0.0)
    assert runner.wanted(7.0).tolist() == [False, True, False]
    assert not runner.wanted(7.01).any()


def test_given_velocities() -> None:
    """Velocities and accelerations that are given are met."""
    points = (
        TrajectoryPoint(1.0, [0.5], [0.4], [0.0]),
        TrajectoryPoint(2.0, [0.6], [0.0], [0.0]),
    )
    runner = running(['left_elbow'], *points, held=HELD)
    at = runner.update(observed(6.0))
    assert at.positions_rad[0] == pytest.approx(0.5)
    assert at.velocities_rad_s[0] == pytest.approx(0.4)


def test_point_at_the_start() -> None:
    """A first point at zero is where it begins."""
    points = TrajectoryPoint(0.0, [0.0]), TrajectoryPoint(1.0, [0.5])
    runner = running(['left_elbow'], *points, held=HELD)
    assert runner.update(observed(5.0)).positions_rad[0] == pytest.approx(0.0)


def test_successor() -> None:
    """A new trajectory takes the place of the one that runs."""
    runner = running(['left_elbow'], TrajectoryPoint(1.0, [0.5]), held=HELD)
    points = [TrajectoryPoint(1.0, [-0.5])]
    runner.accept(checked_trajectory(NAMES, LIMITS, ['left_knee'], points))
    assert runner.wanted(5.5).tolist() == [False, False, True]
    runner.cancel()
    assert not runner.wanted(5.5).any() and not runner.waits


@pytest.mark.parametrize(
    ('points', 'reason'),
    [
        ([], 'It has no points'),
        ([(-1.0, [0.1])], 'first point is at -1 s'),
        ([(0.0, [0.1])], 'only point is at 0 s, which is a jump'),
        ([(1.0, [0.1]), (1.0, [0.2])], 'Point 2 is at 1 s, not after the previous one, at 1 s'),
        ([(1.0, [math.nan])], "position of 'left_elbow' is nan"),
        ([(1.0, [0.1, 0.2])], "field 'position' has length 2"),
        ([(1.0, [0.1]), (2.0, [math.inf])], "position of 'left_elbow' is inf"),
        ([(1.0, [0.1]), (2.0, [0.1, 0.2])], "field 'position' has length 2"),
        (
            [(0.1 * number, [0.0]) for number in range(1001)],
            'It has 1001 points. Give at most 1000',
        ),
        ([(1.0, [])], "field 'position' has length 0"),
        ([(1.0, [1.5])], "Point 1 has 'left_elbow' at 1.5 rad, out of its range"),
        ([(1.0, [1.0]), (1.1, [-1.0])], "'left_elbow' would have to move at 20 rad/s to be at p"),
        ([(1.0, [0.1], [99.0])], "Point 1 moves 'left_elbow' at 99 rad/s, but it can do"),
    ],
)
def test_refused(points: list[tuple[Any, ...]], reason: str) -> None:
    """A trajectory that is not sound is refused with the reason."""
    with pytest.raises(CommandError) as refusal:
        checked_trajectory(
            NAMES, LIMITS, ['left_elbow'], [TrajectoryPoint(*point) for point in points]
        )
    assert reason in str(refusal.value)


def test_some_velocities() -> None:
    """Points that give no velocity among others that do are passed at rest."""
    points = TrajectoryPoint(1.0, [0.2], [0.3]), TrajectoryPoint(2.0, [0.5])
    trajectory = checked_trajectory(NAMES, LIMITS, ['left_elbow'], points)
    assert trajectory.velocities_rad_s is not None
    assert trajectory.velocities_rad_s.tolist() == [[0.3], [0.0]]
    with pytest.raises(CommandError, match="velocity of 'left_elbow' is nan"):
        bad = [TrajectoryPoint(1.0, [0.2], [math.nan])]
        checked_trajectory(NAMES, LIMITS, ['left_elbow'], bad)
