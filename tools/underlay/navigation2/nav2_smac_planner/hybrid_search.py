# SPDX-License-Identifier: Apache-2.0
"""
Hybrid-A*: search for a path that a car can drive.

Source: D. Dolgov, S. Thrun, M. Montemerlo, J. Diebel, Path Planning for Autonomous Vehicles in
Unknown Semi-structured Environments, 2010.
"""

from __future__ import annotations

from collections.abc import Generator
import heapq
import math
import time

from nav2_costmap_2d.costs import MAX_NON_OBSTACLE
from nav2_costmap_2d.grid import Costmap2D
from nav2_planner.route import PlanningError, weight_table
from nav2_smac_planner.curves import sample_curve, Segment, shortest_curve
from nav2_smac_planner.grid_heuristic import GridHeuristic
from nav2_smac_planner.heading_layers import HeadingLayers
from nav2_smac_planner.motions import CHECK_CELLS, HybridOptions, Motion, Motions
from nav2_util.geometry import Pose2D, wrap_angle
import numpy as np
import numpy.typing as npt

__all__ = ['HybridOptions', 'HybridSearch']

FloatArray = npt.NDArray[np.float64]
_YIELD_EVERY = 200


class _Node:
    """A pose that was reached: x and y in cells, and the number of the heading."""

    __slots__ = ('before', 'cost', 'heading', 'is_closed', 'step', 'x', 'y')

    def __init__(
        self, x: float, y: float, heading: int, cost: float, before: _Node | None, step: Motion
    ) -> None:
        self.x, self.y, self.heading, self.cost = x, y, heading, cost
        self.before, self.step, self.is_closed = before, step, False


_NO_STEP = Motion(Segment(0, 0.0), 1.0, (), 0.0, 0.0, 0)


class HybridSearch:
    """
    Search in a costmap for a path between two poses.

    Parameters
    ----------
    costmap
        The costs.
    footprint
        (N, 2) corners of the robot in m in its base frame; None for a circular robot.
    options
        The options of the search.
    start, goal
        Poses in the frame of the costmap.

    """

    def __init__(
        self,
        costmap: Costmap2D,
        footprint: FloatArray | None,
        options: HybridOptions,
        start: Pose2D,
        goal: Pose2D,
    ) -> None:
        self._costmap, self._options = costmap, options
        self._start, self._goal = start, goal
        self._cell_m = costmap.resolution
        self._rows, self._columns = map(int, costmap.cells.shape)
        self._turn_rad = options.turn_rad
        self._layers = HeadingLayers(costmap, footprint, options.headings, options.allow_unknown)
        table = weight_table(
            options.cost_penalty, power=options.cost_power, allow_unknown=options.allow_unknown
        )
        self._table = table.tolist()
        self._grid = table[costmap.cells]
        self._costs = costmap.cells.tobytes()
        self._end = self._place(goal)
        self._motions = Motions(options, self._cell_m)
        self._nodes: dict[int, _Node] = {}
        self._queue: list[tuple[float, int, _Node, list[Segment] | None]] = []
        self._pushed = self._until_curve = 0
        self._best_curve: tuple[float, _Node, list[Segment]] | None = None

    def plan(self) -> Generator[None, None, FloatArray]:
        """
        Search in steps of about ten milliseconds, between which other callbacks can run.

        Returns
        -------
        numpy.ndarray
            (N, 3) x and y in m, yaw in rad, at most a cell apart.

        Raises
        ------
        PlanningError
            There is no path.

        """
        options, began_s = self._options, time.monotonic()
        begin = self._place(self._start)
        self._check(begin, self._start, 'start', may_be_occupied=False)
        self._check(self._end, self._goal, 'goal', may_be_occupied=options.tolerance_m > 0.0)
        self._heuristic = self._make_heuristic()
        yield
        best = _Node(*begin, 0.0, None, _NO_STEP)
        best_apart_m, iterations, approached = math.inf, 0, math.inf
        self._push(0.0, best)
        while self._queue:
            _, _, node, curve = heapq.heappop(self._queue)
            if curve is not None:
                return self._path(node, curve)
            if node.is_closed:
                continue
            node.is_closed = True
            iterations += 1
            apart_m = math.hypot(node.x - self._end[0], node.y - self._end[1]) * self._cell_m
            if apart_m < best_apart_m:
                best, best_apart_m = node, apart_m
                if apart_m <= options.tolerance_m:
                    approached = min(approached, iterations)
            if self._is_goal(node):
                path = self._path(node, [])
                path[-1] = self._goal
                return path
            self._try_curve(node, apart_m)
            if iterations % _YIELD_EVERY == 0:
                yield
                if 0.0 < options.max_time_s < time.monotonic() - began_s:
                    break
            if 0 < options.max_iterations <= iterations:
                break
            if iterations > approached + options.max_approach_iterations:
                break
            self._expand(node)
        if self._best_curve is not None:
            return self._path(*self._best_curve[1:])
        if best_apart_m <= options.tolerance_m:
            return self._path(best, [])
        raise _failure(options, self._goal, iterations, bool(self._queue), best_apart_m)

    def is_free(self, poses: FloatArray) -> bool:
        """
        Check that the robot collides nowhere.

        Parameters
        ----------
        poses
            (M, 3) x and y in m, yaw in rad.

        """
        return self._costs_at(poses) is not None

    def _push(self, cost: float, node: _Node, curve: list[Segment] | None = None) -> None:
        self._pushed += 1
        heapq.heappush(self._queue, (cost, self._pushed, node, curve))

    def _is_goal(self, node: _Node) -> bool:
        """Whether a node is in the cell of the goal, with its heading."""
        x, y, heading = self._end
        return node.heading == heading and int(node.x) == int(x) and int(node.y) == int(y)

    def _place(self, pose: Pose2D) -> tuple[float, float, int]:
        """Return a pose in cells, with the number of its heading."""
        return (
            (pose.x - self._costmap.origin_x) / self._cell_m,
            (pose.y - self._costmap.origin_y) / self._cell_m,
            round(pose.yaw / self._turn_rad) % self._options.headings,
        )

    def _is_inside(self, x: float, y: float) -> bool:
        return 0.0 <= x < self._columns and 0.0 <= y < self._rows

    def _check(
        self, place: tuple[float, float, int], pose: Pose2D, what: str, *, may_be_occupied: bool
    ) -> None:
        """Raise an error if the robot cannot be at an end of the path."""
        x, y, heading = place
        at = f'The {what} ({pose.x:.2f}, {pose.y:.2f})'
        if not self._is_inside(x, y):
            raise PlanningError(
                f'{what.upper()}_OUTSIDE_MAP',
                f'{at} is outside the global costmap. Choose a {what} inside it, or use a '
                'larger map.',
            )
        if may_be_occupied:
            return
        if self._layers.layer(heading)[int(y) * self._columns + int(x)]:
            raise PlanningError(
                f'{what.upper()}_OCCUPIED',
                f'{at} is occupied: the robot would collide there. Clear the global costmap if '
                'nothing is there, or choose another pose.',
            )

    def _make_heuristic(self) -> GridHeuristic:
        x, y, _ = self._end
        heuristic = GridHeuristic(self._grid, (x, y), self._options.tolerance_m, self._cell_m)
        if not heuristic.has_goal:
            raise PlanningError(
                'GOAL_OCCUPIED',
                f'The goal ({self._goal.x:.2f}, {self._goal.y:.2f}) is occupied, and nothing '
                'within the tolerance is free. Choose another goal.',
            )
        return heuristic

    def _expand(self, node: _Node) -> None:
        """Reach the poses at the ends of the motions from a node."""
        options, columns = self._options, self._columns
        keep = 1.0 - options.retrospective_penalty
        steer = node.step.segment.steer
        for step in self._motions.leaving(node.heading):
            x, y, heading = node.x + step.x, node.y + step.y, step.heading
            if not self._is_inside(x, y):
                continue
            place = int(y) * columns + int(x)
            if self._layers.layer(heading)[place]:
                continue
            key = place * options.headings + heading
            known = self._nodes.get(key)
            factor = step.factor
            if step.segment.steer * steer < 0:
                factor += options.change_penalty
            way = abs(step.segment.length_m) * factor * keep
            cost = node.cost + way * self._table[self._costs[place]]
            if known is not None and (known.is_closed or known.cost <= cost):
                continue
            remaining = self._heuristic.estimate(x, y)
            if remaining == math.inf or self._hits(node, step):
                continue
            reached = self._nodes[key] = _Node(x, y, heading, cost, node, step)
            self._push(cost + remaining, reached)

    def _hits(self, node: _Node, step: Motion) -> bool:
        """Whether the robot collides on the way of a motion."""
        for dx, dy, heading in step.on_the_way:
            x, y = node.x + dx, node.y + dy
            if not self._is_inside(x, y):
                return True
            if self._layers.layer(heading)[int(y) * self._columns + int(x)]:
                return True
        return False

    def _try_curve(self, node: _Node, apart_m: float) -> None:
        """From time to time, consider a curve from a node to the goal."""
        options = self._options
        self._until_curve -= 1
        if self._until_curve > 0 or apart_m > options.expansion_max_length_m:
            return
        self._until_curve = max(1, int(apart_m / self._cell_m / options.expansion_ratio))
        pose = self._pose(node)
        curve = shortest_curve(
            pose,
            self._goal,
            options.radius_m,
            can_reverse=options.can_reverse,
            reverse_factor=options.reverse_penalty,
        )
        length_m = sum(abs(each.length_m) for each in curve)
        if length_m > options.expansion_max_length_m:
            return
        poses = sample_curve(pose, curve, options.radius_m, CHECK_CELLS * self._cell_m)
        costs = self._costs_at(poses)
        if costs is None:
            return
        is_near = length_m < math.pi * options.radius_m and options.expand_at_any_cost
        highest = max((each for each in costs if each <= MAX_NON_OBSTACLE), default=0)
        if highest > options.expansion_max_cost and not is_near:
            return
        weight = sum(self._table[each] for each in costs) / max(len(costs), 1)
        ways = (abs(each.length_m) * self._motions.factor(each) for each in curve)
        keep = 1.0 - options.retrospective_penalty
        cost = node.cost + sum(ways) * weight * keep
        if self._best_curve is None or cost < self._best_curve[0]:
            self._best_curve = cost, node, curve
            self._push(cost, node, curve)

    def _costs_at(self, poses: FloatArray) -> list[int] | None:
        """Return the costs at the centres of poses; None for a collision."""
        found = []
        for pose in poses.tolist():
            x, y, heading = self._place(Pose2D(*pose))
            if not self._is_inside(x, y):
                return None
            place = int(y) * self._columns + int(x)
            if self._layers.layer(heading)[place]:
                return None
            found.append(self._costs[place])
        return found

    def _pose(self, node: _Node) -> Pose2D:
        """Return the pose of a node; that of the first one is the start itself."""
        if node.before is None:
            return self._start
        return Pose2D(
            self._costmap.origin_x + node.x * self._cell_m,
            self._costmap.origin_y + node.y * self._cell_m,
            wrap_angle(node.heading * self._turn_rad),
        )

    def _path(self, node: _Node, curve: list[Segment]) -> FloatArray:
        """Return the poses of the path to a node, and on along a curve."""
        parts = [sample_curve(self._pose(node), curve, self._options.radius_m, self._cell_m)]
        while node.before is not None:
            before = self._pose(node.before)
            way = [node.step.segment]
            part = sample_curve(before, way, self._options.radius_m, self._cell_m)
            parts.append(part)
            node = node.before
        parts.append(np.array([self._start]))
        return np.concatenate(parts[::-1])


def _failure(
    options: HybridOptions, goal: Pose2D, iterations: int, is_cut_short: bool, apart_m: float
) -> PlanningError:
    """Make the error for a search that has found no path."""
    closest = f'The nearest place that was reached is {apart_m:.2f} m from it'
    where = f'to the goal ({goal.x:.2f}, {goal.y:.2f})'
    if not is_cut_short:
        return PlanningError(
            'NO_VALID_PATH',
            f'There is no path {where} that a robot with a turning radius of '
            f'{options.radius_m:g} m can drive. {closest}; the tolerance is '
            f'{options.tolerance_m:g} m. Clear the way, clear the global costmap, or choose '
            'another goal.',
        )
    if 0 < options.max_iterations <= iterations:
        return PlanningError(
            'NO_VALID_PATH',
            f'No path {where} was found in {iterations} iterations; max_iterations allows no '
            f'more. {closest}. Increase it, or choose a nearer goal.',
        )
    return PlanningError(
        'TIMEOUT',
        f'No path {where} was found within {options.max_time_s:g} s. {closest}. Increase '
        'max_planning_time, or use a coarser costmap.',
    )
