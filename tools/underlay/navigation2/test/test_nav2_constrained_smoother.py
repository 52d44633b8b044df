# SPDX-License-Identifier: Apache-2.0
"""The optimizer of the constrained smoother, and what its parameters do."""

from __future__ import annotations

import math
from typing import Any

from nav2_constrained_smoother import ConstrainedSmoother
from nav2_constrained_smoother.optimization import CostField, minimize, Objective, Termination
from nav2_costmap_2d.grid import Costmap2D
from nav2_util.errors import ConfigurationError
from nav2_util.lifecycle_node import LifecycleNode
import numpy as np
import pytest
from rclpy.parameter import Parameter

NO_TOLERANCE = Termination(iterations=200, fn_tol=0.0, gradient_tol=0.0, param_tol=0.0)


def corner(count: int = 61, spacing_m: float = 0.05) -> np.ndarray:
    """Return poses along x, and then along y."""
    half = count // 2
    x = np.minimum(np.arange(count), half) * spacing_m
    y = np.maximum(np.arange(count) - half, 0) * spacing_m
    return np.column_stack([x, y, np.where(np.arange(count) < half, 0.0, math.pi / 2)])


def curvatures(points: np.ndarray) -> np.ndarray:
    """Return the curvature at each inner point, in 1/m."""
    apart = np.diff(points[:, :2], axis=0)
    angles = np.unwrap(np.arctan2(apart[:, 1], apart[:, 0]))
    lengths = np.hypot(*apart.T)
    return np.abs(np.diff(angles)) / (0.5 * (lengths[1:] + lengths[:-1]))


def ridge(height: float = 200.0) -> Costmap2D:
    """Return a costmap of 6 by 6 m from (-1, -3): costs fall with the distance from y = 0."""
    y = -3.0 + 0.05 * (np.arange(120) + 0.5)
    costs = height * np.clip(1.0 - np.abs(y), 0.0, 1.0)
    cells = np.repeat(costs[:, None], 120, axis=1).astype(np.uint8)
    return Costmap2D(120, 120, 0.05, -1.0, -3.0, cells=cells)


@pytest.fixture
def made(ros: Any) -> Any:
    """Return a function that makes a smoother with parameters, and its node."""

    def make(**values: Any) -> ConstrainedSmoother:
        given = {f'mine.{name.replace("__", ".")}': value for name, value in values.items()}
        node = ros.make(LifecycleNode, given, node_name='smoothing')
        return ConstrainedSmoother(node, 'mine')

    return make


def test_costs_between_cells():
    """They are those of the cells at their centres, linear between, and constant outside."""
    cells = np.array([[0, 100], [50, 255]], np.uint8)
    field = CostField(Costmap2D(2, 2, 0.1, 1.0, 2.0, cells=cells))
    points = np.array([[1.05, 2.05], [1.15, 2.05], [1.1, 2.05], [1.1, 2.1], [9.0, 2.05]])
    values, gradients = field.at(points)
    assert values == pytest.approx([0.0, 100.0, 50.0, 37.5, 100.0])
    assert gradients[2] == pytest.approx([1000.0, 0.0])
    assert gradients[4] == pytest.approx([0.0, 0.0])


@pytest.mark.parametrize('is_reversed', [False, True])
def test_derivatives_are_those_of_the_residuals(is_reversed):
    """By differences, for every term at once."""
    from nav2_constrained_smoother import optimization

    random = np.random.default_rng(3)
    points = corner(13, 0.1)[:, :2] + random.normal(0.0, 0.02, (13, 2)) + (0.003, 0.004)
    objective = Objective(
        50.0, 3.0, 2.0, np.linspace(0.01, 0.02, 13), 0.5,
        np.array([[0.2, 0.1, 1.0], [-0.1, 0.0, 2.0]]), is_reversed,
    )  # fmt: skip
    costs, free = CostField(ridge()), np.ones(13, bool)
    free[[0, 3, -1]] = False
    originals = points + 0.01
    residuals, jacobian = optimization._linearized(points, originals, free, objective, costs)
    columns = []
    for index in np.flatnonzero(free):
        for axis in range(2):
            ends = []
            for step in (1e-6, -1e-6):
                moved = points.copy()
                moved[index, axis] += step
                ends.append(optimization._linearized(moved, originals, free, objective, costs)[0])
            columns.append((ends[0] - ends[1]) / 2e-6)
    assert len(residuals) > 5 * 11
    assert jacobian.toarray() == pytest.approx(np.column_stack(columns), abs=1e-3, rel=1e-4)


def test_the_optimum_of_a_quadratic_is_exact():
    """With smoothness and distance only, the solution is that of linear equations."""
    points = corner(21)[:, :2]
    count = len(points)
    objective = Objective(4.0, 0.0, 1.0, np.zeros(count))
    found = minimize(points, np.zeros(count, bool), objective, None, NO_TOLERANCE)
    second = np.zeros((count - 2, count))
    for row in range(count - 2):
        second[row, [row, row + 1, row + 2]] = (1.0, -2.0, 1.0)
    inner = slice(1, count - 1)
    matrix = 4.0 * (second.T @ second) + np.eye(count)
    fixed = matrix[:, [0, -1]] @ points[[0, -1]]
    wanted = np.linalg.solve(matrix[inner, inner], points[inner] - fixed[inner])
    assert found.points[inner] == pytest.approx(wanted, abs=1e-6)
    assert found.points[[0, -1]] == pytest.approx(points[[0, -1]])
    assert found.final < found.initial


def test_bends_keep_the_turning_radius(made):
    """With the default weights a corner becomes a bend that a car can drive."""
    poses = corner()
    found = made(minimum_turning_radius=0.5).smooth(poses, None)
    assert curvatures(poses).max() > 20.0
    assert curvatures(found).max() < 1.0 / 0.5 + 0.1
    assert found[[0, -1]] == pytest.approx(poses[[0, -1]])
    steps = np.diff(found[:, :2], axis=0)
    assert found[1:-1, 2] == pytest.approx(np.arctan2(steps[1:, 1], steps[1:, 0]))


def test_costs_push_the_path_away(made):
    """A straight path along a ridge of costs moves to its side, the more the greater w_cost."""
    poses = np.column_stack([np.arange(61) * 0.05, np.full(61, 0.1), np.zeros(61)])
    away = [
        made(w_cost=weight, w_smooth=1e3).smooth(poses, ridge())[30, 1]
        for weight in (0.0, 1e-3, 0.015)
    ]
    assert away[0] == pytest.approx(0.1, abs=1e-3)
    assert away[0] + 0.05 < away[1] < away[2]


def test_costs_are_looked_up_at_points_of_the_robot(made):
    """With a point on the left that must keep off the ridge, the robot passes it on the right."""
    poses = np.column_stack([np.arange(61) * 0.05, np.full(61, -0.3), np.zeros(61)])
    smoother = made(w_smooth=1e3, cost_check_points=[0.0, 0.5, 1.0])
    found = smoother.smooth(poses, ridge())
    assert found[30, 1] > -0.2  # its left side is then beyond the ridge
    assert made(w_smooth=1e3).smooth(poses, ridge())[30, 1] < -0.4


def test_cusps_stay_and_cost_more(made):
    """Where the path reverses it stays; backwards it faces backwards; w_cost rises there."""
    out = np.linspace(0.0, 2.0, 41)
    poses = np.zeros((81, 3))
    poses[:41, 0], poses[41:, 0] = out, out[::-1][1:]
    poses[:, 1] = 0.4 + 0.02 * np.sin(np.arange(81))
    smoother = made(w_smooth=1e3, w_cost=1e-3)
    found = smoother.smooth(poses, ridge())
    assert found.shape == poses.shape
    assert found[40, :2] == pytest.approx(poses[40, :2])
    assert (np.cos(found[:, 2]) > 0.5).all()
    equal = made(w_smooth=1e3, w_cost=1e-3, w_cost_cusp_multiplier=1.0).smooth(poses, ridge())
    assert found[33, 1] > equal[33, 1] + 0.005
    loose = made(reversing_enabled=False).smooth(poses, None)
    assert loose[40, 0] < 1.9


@pytest.mark.parametrize(('factor', 'count'), [(0, 16), (1, 61), (2, 121)])
def test_sampling(made, factor, count):
    """Every fourth pose is moved; between them the path is a curve, with as many as asked for."""
    smoother = made(path_downsampling_factor=4, path_upsampling_factor=factor)
    found = smoother.smooth(corner(), None)
    assert len(found) == count
    assert found[[0, -1], :2] == pytest.approx(corner()[[0, -1], :2])
    assert curvatures(found).max() < 5.0


def test_orientations_at_the_ends(made):
    """They are those given, with the path in their direction, or those of the path."""
    poses = corner()
    poses[0, 2] = poses[-1, 2] = 0.3
    found = made().smooth(poses, None)
    assert (found[0, 2], found[-1, 2]) == pytest.approx((0.3, 0.3))
    assert found[1, :2] == pytest.approx(poses[1, :2])
    free = made(keep_start_orientation=False, keep_goal_orientation=False).smooth(poses, None)
    assert free[0, 2] == pytest.approx(math.atan2(*(free[1] - free[0])[1::-1]))
    assert free[-1, 2] == free[-2, 2]


@pytest.mark.parametrize('count', [0, 1, 2, 3, 4, 5])
def test_short_paths(made, count):
    """Paths of a few poses come through."""
    found = made().smooth(corner()[:count], ridge())
    assert found.shape == (count, 3) and np.isfinite(found).all()


def test_points_that_make_no_sense_are_refused(made):
    """At the start and later, with a sentence."""
    with pytest.raises(ConfigurationError, match='x, y and a weight for each point'):
        made(cost_check_points=[0.1, 0.2])
    smoother = made()
    change = Parameter('mine.cost_check_points', value=[0.0, 0.0, -1.0])
    (outcome,) = smoother.node.set_parameters([change])
    assert not outcome.successful and 'negative weights' in outcome.reason


def test_what_the_optimizer_did_is_logged_if_asked_for(made, capfd):
    """The iterations, and how much better the path is."""
    made(optimizer__debug_optimizer=True).smooth(corner(), None)
    said = capfd.readouterr().err
    assert "'mine' has moved 61 points in" in said and 'the objective was' in said
