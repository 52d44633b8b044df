# SPDX-License-Identifier: Apache-2.0
"""Hybrid-A*: the paths that it finds can be driven with a turning radius."""

from __future__ import annotations

from dataclasses import replace
import math

from nav2_costmap_2d.footprint import FootprintCollisionChecker
from nav2_costmap_2d.grid import Costmap2D
from nav2_planner.global_planner import finish
from nav2_planner.path_shape import Rounding
from nav2_planner.route import PlanningError
from nav2_smac_planner.curves import sample_curve, shortest_curve
from nav2_smac_planner.heading_layers import HeadingLayers
from nav2_smac_planner.hybrid_search import HybridSearch
from nav2_smac_planner.hybrid_smoothing import smoothed_path
from nav2_smac_planner.smac_planner_hybrid import HybridParameters
from nav2_util.geometry import Pose2D, wrap_angle
import numpy as np
import pytest

OPTIONS = replace(HybridParameters().options(), max_time_s=0.0, max_iterations=200_000)
REVERSING = replace(OPTIONS, can_reverse=True)
FEW = {'max_iterations': 3, 'expansion_max_length_m': 0.5}
CAR = np.array([[0.35, 0.15], [0.35, -0.15], [-0.15, -0.15], [-0.15, 0.15]])


def room(*walls: tuple[float, float, float, float]) -> Costmap2D:
    """Return a costmap of 6 x 4 m with walls from x, y to x, y, and what is near them."""
    grid = Costmap2D(120, 80, 0.05, 0.0, 0.0, 0)
    y, x = (np.mgrid[:80, :120] + 0.5) * 0.05
    for left, low, right, high in walls:
        apart = np.hypot(
            np.maximum(np.maximum(left - x, x - right), 0.0),
            np.maximum(np.maximum(low - y, y - high), 0.0),
        )
        grid.cells[:] = np.maximum(
            grid.cells, np.select([apart <= 0.0, apart < 0.15, apart < 0.6], [254, 253, 60], 0)
        )
    return grid


def plan(grid, start, goal, options=OPTIONS, footprint=None):
    return finish(HybridSearch(grid, footprint, options, Pose2D(*start), Pose2D(*goal)).plan())


def check(grid, poses, radius_m, footprint=None):
    """Assert that a path can be driven, and collides with nothing; return its motions in m."""
    steps = np.diff(poses[:, :2], axis=0)
    lengths = np.hypot(*steps.T)
    turns = np.abs([wrap_angle(each) for each in np.diff(poses[:, 2])])
    assert lengths.max() < 0.08
    # The ends of a path may be a heading and a cell off the grid of headings.
    assert (turns <= lengths / radius_m + 0.05).all()
    middle = poses[:-1, 2] + 0.5 * np.array([wrap_angle(each) for each in np.diff(poses[:, 2])])
    along = steps[:, 0] * np.cos(middle) + steps[:, 1] * np.sin(middle)
    assert (np.abs(along) > 0.9 * lengths - 0.01).all()
    costs = FootprintCollisionChecker(grid).footprint_costs(poses, footprint)
    assert (costs < (253 if footprint is None else 254)).all()
    return along


@pytest.mark.parametrize('can_reverse', [False, True])
def test_curves_end_at_the_goal(can_reverse):
    """From any pose to any pose; with reversing they are not longer."""
    random = np.random.default_rng(1)
    for values in random.uniform(-3.0, 3.0, (200, 6)):
        start, goal = Pose2D(*values[:3]), Pose2D(*values[3:])
        curve = shortest_curve(start, goal, 0.5, can_reverse=can_reverse)
        end = sample_curve(start, curve, 0.5, 0.1)[-1]
        assert end[:2] == pytest.approx(goal[:2], abs=1e-6)
        assert wrap_angle(end[2] - goal.yaw) == pytest.approx(0.0, abs=1e-6)
        forward = shortest_curve(start, goal, 0.5, can_reverse=False)
        assert all(each.length_m > 0.0 for each in forward)
        length = sum(abs(each.length_m) for each in curve)
        assert length <= sum(each.length_m for each in forward) + 1e-9


def test_straight_on():
    """In free space to a goal ahead, the path is a straight line."""
    poses = plan(room(), (1.0, 2.0, 0.0), (5.0, 2.0, 0.0))
    assert poses[0] == pytest.approx((1.0, 2.0, 0.0))
    assert poses[-1] == pytest.approx((5.0, 2.0, 0.0))
    assert np.abs(poses[:, 1] - 2.0).max() < 0.03
    check(room(), poses, OPTIONS.radius_m)


def test_turning_round_takes_a_circle():
    """A car that only drives forward turns with its radius; the goal has its yaw."""
    grid = room()
    poses = plan(grid, (3.0, 1.0, 0.0), (3.0, 2.2, math.pi))
    along = check(grid, poses, OPTIONS.radius_m)
    assert (along > -0.01).all()
    assert poses[-1, :2] == pytest.approx((3.0, 2.2)) and abs(poses[-1, 2]) > 3.1


def test_round_a_wall():
    """The path leads through the gap."""
    grid = room((2.9, 0.0, 3.1, 2.6))
    poses = plan(grid, (1.0, 1.0, 0.0), (5.0, 1.0, 0.0))
    check(grid, poses, OPTIONS.radius_m)
    assert poses[-1] == pytest.approx((5.0, 1.0, 0.0), abs=1e-6)
    assert poses[:, 1].max() > 2.6


def test_backing_out_of_a_dead_end():
    """A car with a footprint leaves a narrow place backward, if it may."""
    grid = room((0.0, 1.55, 2.0, 1.7), (0.0, 2.3, 2.0, 2.45), (0.0, 1.7, 0.4, 2.3))
    start, goal = (1.0, 2.0, math.pi), (2.8, 2.0, math.pi)
    poses = plan(grid, start, goal, REVERSING, CAR)
    along = check(grid, poses, REVERSING.radius_m, CAR)
    assert (along < -0.01).any()
    with pytest.raises(PlanningError, match='turning radius of 0.4 m') as failure:
        plan(grid, start, goal, OPTIONS, CAR)
    assert failure.value.reason == 'NO_VALID_PATH'


def test_layers_of_a_footprint():
    """A long robot fits along a wall and not across it; outside of the map it collides."""
    grid = room((0.0, 0.0, 6.0, 1.0))
    layers = HeadingLayers(grid, CAR, 72, True)

    def is_free(x, y, heading):
        return not layers.layer(heading)[int(y / 0.05) * 120 + int(x / 0.05)]

    assert is_free(3.0, 1.25, 0) and not is_free(3.0, 1.25, 54)
    assert not is_free(3.0, 1.3, 54) and is_free(3.0, 1.45, 54)
    assert not is_free(5.8, 2.0, 0) and is_free(5.8, 2.0, 36)


@pytest.mark.parametrize(
    ('start', 'goal', 'options', 'reason', 'said'),
    [
        ((1.0, 2.0, 0.0), (9.0, 2.0, 0.0), {}, 'GOAL_OUTSIDE_MAP', 'outside'),
        ((3.0, 2.0, 0.0), (5.0, 2.0, 0.0), {}, 'START_OCCUPIED', 'The start .3.00, 2.00. is'),
        ((-1.0, 2.0, 0.0), (5.0, 2.0, 0.0), {}, 'START_OUTSIDE_MAP', 'The start .-1.00'),
        ((1.0, 2.0, 0.0), (3.0, 2.0, 0.0), {'tolerance_m': 0.0}, 'GOAL_OCCUPIED', 'The goal'),
        ((1.0, 2.0, 0.0), (5.0, 2.0, 0.0), {}, 'NO_VALID_PATH', 'There is no path to the goal'),
        ((1.0, 2.0, 0.0), (2.0, 3.0, 0.0), FEW, 'NO_VALID_PATH', 'max_iterations allows no more'),
    ],
)
def test_failures(start, goal, options, reason, said):
    """Each has its reason and a sentence."""
    grid = room((2.9, 0.0, 3.1, 4.0))
    with pytest.raises(PlanningError, match=said) as failure:
        plan(grid, start, goal, replace(OPTIONS, **options))
    assert failure.value.reason == reason


def test_a_goal_in_a_wall_is_approached_within_the_tolerance():
    """The path ends near it."""
    grid = room((4.0, 1.0, 4.2, 3.0))
    options = replace(OPTIONS, tolerance_m=0.5, max_approach_iterations=100)
    poses = plan(grid, (1.0, 2.0, 0.0), (4.1, 2.0, 0.0), options)
    assert math.hypot(poses[-1, 0] - 4.1, poses[-1, 1] - 2.0) <= 0.5
    check(grid, poses, options.radius_m)


ROUNDING = Rounding(0.3, 0.2, 3)


def _bends(poses):
    """Return how much the curvature changes along a path, in 1/m per pose, at most."""
    yaws = np.unwrap(np.arctan2(*np.diff(poses[:, :2], axis=0).T[::-1]))
    lengths = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    return np.abs(np.diff(np.diff(yaws) / lengths[1:])).max()


@pytest.mark.parametrize(
    ('walls', 'start', 'goal', 'options'),
    [
        ([(2.9, 0.0, 3.1, 2.6)], (1.0, 1.0, 0.0), (5.0, 1.0, 0.0), OPTIONS),
        ([], (3.0, 1.0, 0.0), (3.0, 2.2, math.pi), OPTIONS),
        ([], (1.0, 1.0, 0.0), (2.0, 1.4, 0.0), REVERSING),
        ([], (2.0, 2.0, 0.0), (2.0, 2.6, math.pi), REVERSING),
    ],
    ids=['wall', 'circle', 'lane', 'cusps'],
)
def test_smooth_paths_can_be_driven(walls, start, goal, options):
    """The steering changes more slowly; ends, cusps and the turning radius stay."""
    grid = room(*walls)
    search = HybridSearch(grid, CAR, options, Pose2D(*start), Pose2D(*goal))
    poses = finish(search.plan())
    found = smoothed_path(poses, ROUNDING, options.radius_m, search.is_free)
    assert found.shape == poses.shape
    assert found[[0, -1]] == pytest.approx(poses[[0, -1]])
    along = check(grid, found, options.radius_m, CAR)
    before = check(grid, poses, options.radius_m, CAR)
    assert (np.sign(along) == np.sign(before)).all()
    if not (along < 0.0).any():
        assert _bends(found) < 0.8 * _bends(poses)


def test_what_would_collide_is_not_smoothed():
    """Then the path is as it was."""
    search = HybridSearch(room(), None, OPTIONS, Pose2D(1.0, 1.0, 0.0), Pose2D(3.0, 3.0, 1.0))
    poses = finish(search.plan())
    assert smoothed_path(poses, ROUNDING, OPTIONS.radius_m, lambda _: False) == pytest.approx(
        poses
    )
    found = smoothed_path(poses, ROUNDING, OPTIONS.radius_m, lambda _: True)
    assert np.abs(found - poses).max() > 1e-3


@pytest.mark.parametrize('count', [1, 2, 5])
def test_short_paths_stay(count):
    """There is nothing to smooth."""
    poses = np.column_stack([np.arange(count) * 0.05, np.zeros(count), np.zeros(count)])
    assert smoothed_path(poses, ROUNDING, 0.4, lambda _: True) == pytest.approx(poses)
