# SPDX-License-Identifier: Apache-2.0
"""Optimize the points of a path for smoothness, curvature, and distance from obstacles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from nav2_costmap_2d.costs import NO_INFORMATION
from nav2_costmap_2d.grid import Costmap2D
import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_matrix, csr_matrix, diags
from scipy.sparse.linalg import spsolve

__all__ = ['CostField', 'Objective', 'Optimum', 'Termination', 'minimize']

FloatArray = npt.NDArray[np.float64]
_Term = tuple[FloatArray, FloatArray]
"""Residuals (M,), and their derivatives by the points before, at and after each, (M, 3, 2)."""

_SHORTEST_M = 1e-9
_FIRST_DAMPING = 1e-4
_MOST_DAMPING = 1e12


class CostField:
    """
    Costs of a costmap at any point, by bilinear interpolation between the centres of cells.

    Parameters
    ----------
    costmap
        The costmap. Unknown space costs nothing; outside, the costs of the border continue.

    """

    def __init__(self, costmap: Costmap2D) -> None:
        cells = costmap.cells
        self._costs = np.where(cells == NO_INFORMATION, 0, cells).astype(np.float64)
        self._origin = np.array([costmap.origin_x, costmap.origin_y])
        self._resolution = costmap.resolution

    def at(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """
        Interpolate costs.

        Parameters
        ----------
        points
            (N, 2) x and y in m.

        Returns
        -------
        (N,) costs from 0 to 254, and (N, 2) their gradients per metre.

        """
        rows, columns = self._costs.shape
        cells = (points - self._origin) / self._resolution - 0.5
        most = np.array([columns - 1, rows - 1], float)
        inside = (cells > 0.0) & (cells < most)
        cells = np.clip(cells, 0.0, most)
        low = np.minimum(cells.astype(np.intp), np.maximum(most.astype(np.intp) - 1, 0))
        u, v = (cells - low).T
        x, y = low.T
        right, above = np.minimum(x + 1, columns - 1), np.minimum(y + 1, rows - 1)
        a, b = self._costs[y, x], self._costs[y, right]
        c, d = self._costs[above, x], self._costs[above, right]
        bottom, top = a + u * (b - a), c + u * (d - c)
        slopes = np.stack([(1.0 - v) * (b - a) + v * (d - c), top - bottom], axis=1)
        return bottom + v * (top - bottom), np.where(inside, slopes / self._resolution, 0.0)


@dataclass(frozen=True)
class Objective:
    """
    What a smooth path is: the weights of the squares of its residuals.

    The points of the path are about equally far apart.
    """

    smooth: float
    """Of the second differences of the points, in m."""
    curve: float
    """Of the curvature beyond `max_curvature`, in 1/m."""
    dist: float
    """Of the distances in m from the original points."""
    cost: FloatArray
    """(N,) of the costs of the costmap at each point, from 0 to 254."""
    max_curvature: float = np.inf
    """In 1/m: the inverse of the minimum turning radius."""
    check_points: FloatArray = field(default_factory=lambda: np.array([[0.0, 0.0, 1.0]]))
    """(M, 3) where on the robot costs are looked up: x and y (m) in its frame, and weights."""
    is_reversed: bool = False
    """Whether the robot drives backwards."""


@dataclass(frozen=True)
class Termination:
    """When the optimization ends."""

    iterations: int = 100
    """Maximum number of iterations."""
    fn_tol: float = 1e-7
    """Relative decrease of the objective below which it ends."""
    gradient_tol: float = 1e-10
    """Largest component of the gradient below which it ends."""
    param_tol: float = 1e-15
    """Relative length of a step below which it ends."""


@dataclass(frozen=True)
class Optimum:
    """Result of an optimization."""

    points: FloatArray
    """(N, 2) x and y in m."""
    iterations: int
    initial: float
    """The objective of the original points."""
    final: float


def minimize(
    points: FloatArray,
    held: npt.NDArray[np.bool_],
    objective: Objective,
    costs: CostField | None,
    termination: Termination,
) -> Optimum:
    """
    Move the points of a path to where the objective is least nearby.

    Parameters
    ----------
    points
        (N, 2) x and y in m; at least three.
    held
        (N,) whether a point must stay where it is; the ends always stay.
    objective
        The weights.
    costs
        The costs of the costmap; None if there is no costmap.
    termination
        When to end.

    Notes
    -----
    The method of Levenberg and Marquardt: D. W. Marquardt, "An algorithm for least-squares
    estimation of nonlinear parameters", 1963; with sparse normal equations, since each residual
    depends on three adjacent points.

    """
    free = ~held
    free[[0, -1]] = False
    current, damping, iteration = points.astype(np.float64), _FIRST_DAMPING, 0
    residuals, jacobian = _linearized(current, points, free, objective, costs)
    initial = value = reached = 0.5 * float(residuals @ residuals)
    while free.any() and iteration < termination.iterations:
        gradient = jacobian.T @ residuals
        if np.abs(gradient).max() <= termination.gradient_tol:
            break
        normal = (jacobian.T @ jacobian).tocsc()
        scale = np.maximum(normal.diagonal(), 1e-9)
        while damping < _MOST_DAMPING:
            iteration += 1
            step = spsolve(normal + diags(damping * scale, format='csc'), -gradient)
            moved = current.copy()
            moved[free] += step.reshape(-1, 2)
            residuals, jacobian = _linearized(moved, points, free, objective, costs)
            reached = 0.5 * float(residuals @ residuals)
            if reached <= value or iteration >= termination.iterations:
                break
            damping *= 5.0
        if not reached <= value:
            break
        decrease, value = value - reached, reached
        length = float(np.linalg.norm(step))
        small = termination.param_tol * (float(np.linalg.norm(current)) + termination.param_tol)
        current, damping = moved, max(damping / 5.0, 1e-12)
        if decrease <= termination.fn_tol * value or length <= small:
            break
    return Optimum(current, iteration, initial, value)


def _linearized(
    points: FloatArray,
    originals: FloatArray,
    free: npt.NDArray[np.bool_],
    objective: Objective,
    costs: CostField | None,
) -> tuple[FloatArray, csr_matrix]:
    """Compute all residuals, and their derivatives by the coordinates of the free points."""
    residuals: list[FloatArray] = []
    rows: list[npt.NDArray[np.intp]] = []
    columns: list[npt.NDArray[np.intp]] = []
    values: list[FloatArray] = []
    count = len(points)
    column = np.full(count, -1)
    column[free] = np.arange(np.count_nonzero(free))
    around = np.arange(1, count - 1)[:, None] + np.array([-1, 0, 1])
    total = 0
    for found, slopes in _terms(points, originals, objective, costs):
        row = np.broadcast_to(total + np.arange(count - 2)[:, None, None], slopes.shape)
        where = 2 * column[around][:, :, None] + np.array([0, 1])
        is_free = np.broadcast_to(free[around][:, :, None], slopes.shape)
        residuals.append(found)
        rows.append(row[is_free])
        columns.append(where[is_free])
        values.append(slopes[is_free])
        total += count - 2
    jacobian = coo_matrix(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
        shape=(total, 2 * np.count_nonzero(free)),
    )
    return np.concatenate(residuals), jacobian.tocsr()


def _terms(
    points: FloatArray, originals: FloatArray, objective: Objective, costs: CostField | None
) -> Iterator[_Term]:
    """Yield the residuals of each inner point."""
    before, after = points[1:-1] - points[:-2], points[2:] - points[1:-1]
    count = len(before)
    for axis in range(2):
        weight = np.sqrt(objective.smooth)
        slopes = np.zeros((count, 3, 2))
        slopes[:, :, axis] = weight * np.array([1.0, -2.0, 1.0])
        yield weight * (after - before)[:, axis], slopes
        if objective.dist > 0.0:
            weight = np.sqrt(objective.dist)
            slopes = np.zeros((count, 3, 2))
            slopes[:, 1, axis] = weight
            yield weight * (points - originals)[1:-1, axis], slopes
    if objective.curve > 0.0 and np.isfinite(objective.max_curvature):
        yield _curvature(before, after, objective)
    if costs is not None:
        yield from _costs(points, objective, costs)


def _curvature(before: FloatArray, after: FloatArray, objective: Objective) -> _Term:
    """Compute how much the curvature exceeds its maximum: turning angle by mean length."""
    lengths = [np.maximum(np.hypot(*each.T), _SHORTEST_M)[:, None] for each in (before, after)]
    turn = np.arctan2(
        before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1)
    )[:, None]
    mean = 0.5 * (lengths[0] + lengths[1])
    curvature = np.abs(turn) / mean
    excess = curvature - objective.max_curvature
    slopes_by = []
    for line, length, sign in ((before, lengths[0], -1.0), (after, lengths[1], 1.0)):
        across = np.stack([-line[:, 1], line[:, 0]], axis=1) / length**2
        slopes_by.append(
            np.sign(turn) * sign * across / mean - curvature / mean * line / (2.0 * length)
        )
    slopes = np.stack([-slopes_by[0], slopes_by[0] - slopes_by[1], slopes_by[1]], axis=1)
    weight = np.sqrt(objective.curve) * (excess > 0.0)
    return (weight * excess)[:, 0], weight[:, :, None] * slopes


def _costs(points: FloatArray, objective: Objective, costs: CostField) -> Iterator[_Term]:
    """Yield the costs at each point of the robot that is to be checked."""
    along = points[2:] - points[:-2]
    if objective.is_reversed:
        along = -along
    length = np.maximum(np.hypot(*along.T), _SHORTEST_M)[:, None]
    forward = along / length
    left = np.stack([-forward[:, 1], forward[:, 0]], axis=1)
    direction = -1.0 if objective.is_reversed else 1.0
    for x, y, share in objective.check_points:
        weight = np.sqrt(share * objective.cost[1:-1])[:, None]
        found, gradient = costs.at(points[1:-1] + x * forward + y * left)
        slopes = np.zeros((len(found), 3, 2))
        slopes[:, 1] = weight * gradient
        # The heading turns by left / length per metre of the point after, sideways.
        turned = (gradient * (x * left - y * forward)).sum(axis=1)[:, None]
        slopes[:, 2] = weight * direction * turned * left / length
        slopes[:, 0] = -slopes[:, 2]
        yield weight[:, 0] * found, slopes
