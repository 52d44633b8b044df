# SPDX-License-Identifier: Apache-2.0
"""Plan a path in a costmap, or report why there is none."""

from __future__ import annotations

from collections.abc import Generator
import math
import time

from nav2_costmap_2d.costs import (
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
)
from nav2_costmap_2d.grid import Costmap2D
from nav2_planner.grid_graph import Cell, FloatGrid
from nav2_planner.grid_search import GridSearch, SearchGrid
from nav2_planner.path_shape import line_costs, pull_taut
from nav2_planner.route import PlanningError, Route, SearchOptions
from nav2_util.geometry import Pose2D
import numpy as np
import numpy.typing as npt

__all__ = ['GridPlanner']

FloatArray = npt.NDArray[np.float64]

_ESCAPE_M = 1.0
_ADVICE_M = 5.0


class GridPlanner:
    """
    Planner in costmaps, for a robot whose centre must avoid costs of 253 and above.

    Parameters
    ----------
    diagonal
        Whether to search in 8 directions instead of 4.

    """

    def __init__(self, diagonal: bool = True) -> None:
        self.search = GridSearch(diagonal)

    def plan(
        self, costmap: Costmap2D, start: Pose2D, goal: Pose2D, options: SearchOptions
    ) -> Generator[None, None, Route]:
        """
        Plan a path in steps of about ten milliseconds, between which other callbacks can run.

        Parameters
        ----------
        costmap
            The costs.
        start, goal
            Poses in the frame of the costmap.
        options
            The options of the search.

        Raises
        ------
        PlanningError
            There is no path.

        See Also
        --------
        nav2_planner.global_planner.finish : Plans in one step.

        """
        began = time.monotonic()
        self._check_inside(costmap, start, 'start')
        self._check_inside(costmap, goal, 'goal')
        weights = _pooled(options.table[costmap.cells], options.factor)
        cell_m = costmap.resolution * options.factor
        grid = self.search.grid_of(weights)
        origin = (costmap.origin_x, costmap.origin_y)
        first, last = (_place(pose, origin, cell_m) for pose in (start, goal))
        begin = self._leave(costmap, grid, start, first, cell_m, options.factor)
        end = self._reachable(costmap, grid, begin, _cell(last), goal, options, cell_m)
        is_exact = end == _cell(last)
        found = yield from self.search.way(grid, begin, end)
        cost = found.cost_from(begin)
        _check_effort(found.costs, cost, options, time.monotonic() - began)
        yield
        corners = pull_taut(grid.weights, found.path_from(begin))
        corners = _with_ends(grid, corners, first, last if is_exact else None)
        return Route(corners, grid.weights, cost * cell_m, cell_m, origin, is_exact)

    def _check_inside(self, costmap: Costmap2D, pose: Pose2D, what: str) -> None:
        if not (math.isfinite(pose.x) and math.isfinite(pose.y) and math.isfinite(pose.yaw)):
            raise PlanningError(
                f'{what.upper()}_OUTSIDE_MAP', f'The {what} has a coordinate that is not a number.'
            )
        if costmap.world_to_map(pose.x, pose.y) is None:
            right = costmap.origin_x + costmap.size_x * costmap.resolution
            top = costmap.origin_y + costmap.size_y * costmap.resolution
            raise PlanningError(
                f'{what.upper()}_OUTSIDE_MAP',
                f'The {what} {_at(pose)} is outside the global costmap, which reaches from '
                f'x {costmap.origin_x:.2f} to {right:.2f} m and from y {costmap.origin_y:.2f} to '
                f'{top:.2f} m. Choose a {what} inside it, or use a larger map.',
            )

    def _leave(
        self,
        costmap: Costmap2D,
        grid: SearchGrid,
        start: Pose2D,
        place: FloatArray,
        cell_m: float,
        factor: int,
    ) -> Cell:
        """Return the start's cell, or the free one next to a robot that is too close to a wall."""
        cell = _cell(place)
        if grid.free[cell]:
            return cell
        cost = costmap.cost_at(start.x, start.y)
        if cost < LETHAL_OBSTACLE:
            weights = np.where(costmap.cells < LETHAL_OBSTACLE, 1.0, np.inf).astype(np.float32)
            out = grid.nearest(cell, grid.free, _ESCAPE_M / cell_m)
            if out is not None:
                ends = (np.array([place, out], float) + 0.5) * factor - 0.5
                ends = np.clip(ends, 0, np.array(costmap.cells.shape) - 1)
                if math.isfinite(line_costs(weights, ends[:1], ends[1:])[0]):
                    return out
        raise PlanningError(
            'START_OCCUPIED',
            f'The start {_at(start)} is {_kind(cost)}. {_nearest_free(grid, cell, cell_m)} Move '
            'the robot away from the obstacle, clear the global costmap if none is there, or '
            'correct the estimate of its pose.',
        )

    def _reachable(
        self,
        costmap: Costmap2D,
        grid: SearchGrid,
        begin: Cell,
        target: Cell,
        goal: Pose2D,
        options: SearchOptions,
        cell_m: float,
    ) -> Cell:
        """Find the goal's cell, or the nearest reachable one within the tolerance."""
        region = grid.region_of(begin)
        if region[target]:
            return target
        near = grid.nearest(target, region, options.tolerance_m / cell_m)
        if near is not None:
            return near
        around = grid.nearest(target, region, max(region.shape) * 2)
        apart = math.hypot(around[0] - target[0], around[1] - target[1]) if around else math.inf
        closest = (
            f'The nearest place that the robot can reach is {apart * cell_m:.2f} m away; the '
            f'tolerance is {options.tolerance_m:.2f} m.'
        )
        if grid.free[target]:
            raise PlanningError(
                'NO_VALID_PATH',
                f'There is no path from the start to the goal {_at(goal)}: obstacles or unknown '
                f'space cut it off. {closest} Clear the way, clear the global costmap, or choose '
                'another goal.',
            )
        cost = costmap.cost_at(goal.x, goal.y)
        raise PlanningError(
            'GOAL_OCCUPIED',
            f'The goal {_at(goal)} is {_kind(cost)}. {closest} Choose a goal farther from '
            f'obstacles{", or increase the tolerance" if options.tolerance_m > 0.0 else ""}.',
        )


def _check_effort(
    costs: FloatArray, cost: float, options: SearchOptions, elapsed_s: float
) -> None:
    if options.max_cells > 0:
        expanded = int(np.count_nonzero(costs <= cost))
        if expanded > options.max_cells:
            raise PlanningError(
                'NO_VALID_PATH',
                f'The search expanded {expanded} cells; max_iterations allows '
                f'{options.max_cells}. Increase it, or choose a nearer goal.',
            )
    if 0.0 < options.max_time_s < elapsed_s:
        raise PlanningError(
            'TIMEOUT',
            f'The search took {elapsed_s:.2f} s; max_planning_time allows '
            f'{options.max_time_s:.2f} s. Increase it, or use a coarser costmap.',
        )


def _with_ends(
    grid: SearchGrid, corners: FloatArray, first: FloatArray, last: FloatArray | None
) -> FloatArray:
    """Replace the ends of a path by exact points instead of the centres of their cells."""
    if len(corners) == 1 and last is not None:
        both = np.stack([first, last])
        return both if np.hypot(*(last - first)) > 1e-9 else both[1:]
    if not np.array_equal(np.rint(first), corners[0]):
        # The robot is too close to a wall and first moves to a free cell.
        corners = np.concatenate([first[None], corners])
    elif len(corners) == 1:
        corners = np.stack([first, corners[0]])
    elif _is_free_line(grid, first, corners[1]):
        corners[0] = first
    else:
        corners = np.concatenate([first[None], corners])
    if last is None:
        return corners
    if _is_free_line(grid, corners[-2], last):
        corners[-1] = last
        return corners
    return np.concatenate([corners, last[None]])


def _is_free_line(grid: SearchGrid, start: FloatArray, end: FloatArray) -> bool:
    return bool(np.isfinite(line_costs(grid.weights, start[None], end[None])[0]))


def _pooled(weights: FloatGrid, factor: int) -> FloatGrid:
    """Downsample cells by the maximum of their weights."""
    if factor <= 1:
        return weights
    rows, columns = (-(-size // factor) for size in weights.shape)
    padded = np.full((rows * factor, columns * factor), 0.0, np.float32)
    padded[: weights.shape[0], : weights.shape[1]] = weights
    pooled: FloatGrid = padded.reshape(rows, factor, columns, factor).max(axis=(1, 3))
    return pooled


def _place(pose: Pose2D, origin: tuple[float, float], cell_m: float) -> FloatArray:
    """Compute the row and column of a pose; centres of cells are integers."""
    return np.array([(pose.y - origin[1]) / cell_m - 0.5, (pose.x - origin[0]) / cell_m - 0.5])


def _cell(place: FloatArray) -> Cell:
    return math.floor(place[0] + 0.5), math.floor(place[1] + 0.5)


def _at(pose: Pose2D) -> str:
    return f'({pose.x:.2f}, {pose.y:.2f})'


def _kind(cost: int) -> str:
    if cost == NO_INFORMATION:
        return 'in unknown space, which this planner does not enter (allow_unknown is false)'
    if cost == LETHAL_OBSTACLE:
        return 'in an obstacle'
    if cost == INSCRIBED_INFLATED_OBSTACLE:
        return 'closer to an obstacle than the radius of the robot'
    return 'in a coarse cell with an obstacle'


def _nearest_free(grid: SearchGrid, cell: Cell, cell_m: float) -> str:
    found = grid.nearest(cell, grid.free, _ADVICE_M / cell_m)
    if found is None:
        return f'No free cell is within {_ADVICE_M:g} m.'
    apart = math.hypot(found[0] - cell[0], found[1] - cell[1])
    return f'The nearest free cell is {apart * cell_m:.2f} m away.'
