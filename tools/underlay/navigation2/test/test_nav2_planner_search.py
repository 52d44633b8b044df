# SPDX-License-Identifier: Apache-2.0
"""The search of the planners: ways, lines and corners in grids, without ROS."""

from __future__ import annotations

import math
import time

import cv2
from nav2_costmap_2d.grid import Costmap2D
from nav2_planner.corridor import block_graph, corridor
from nav2_planner.global_planner import finish
from nav2_planner.grid_graph import cost_to_go, CostToGo, way_cost
from nav2_planner.grid_planner import GridPlanner
from nav2_planner.grid_search import GridSearch
from nav2_planner.path_shape import (
    blend_headings,
    headings,
    line_costs,
    pull_taut,
    resample,
    round_corners,
    smoothed,
)
from nav2_planner.planner_server import invalid_poses
from nav2_planner.route import PlanningError, Route, SearchOptions, weight_table
from nav2_util.geometry import Pose2D
import numpy as np
import pytest

CELL_M = 0.05


def rooms(size: int, seed: int, room: int = 40, door: int = 12) -> np.ndarray:
    """Return the inflated costs of rooms with doors and crates."""
    random = np.random.default_rng(seed)
    walls = np.zeros((size, size), np.uint8)
    walls[[0, -1]] = 1
    walls[:, [0, -1]] = 1
    for at in range(room, size, room):
        thick = slice(at, at + 2)
        walls[:, thick] = walls[thick] = 1
    for at in range(room, size, room):
        for along in range(0, size, room):
            for grid in (walls, walls.T):
                gap = along + int(random.integers(3, room - door - 2))
                grid[slice(gap, gap + door), slice(at, at + 2)] = 0
    for _ in range(size * size // 800):
        row, column = random.integers(2, size - 5, 2)
        walls[slice(row, row + 3), slice(column, column + 3)] = 1
    away = cv2.distanceTransform(1 - walls, cv2.DIST_L2, 5) * CELL_M
    costs = np.where(away <= 0.12, 253, 252.0 * np.exp(-3.0 * (away - 0.12))).astype(np.uint8)
    costs[away > 0.6] = 0
    costs[walls > 0] = 254
    return costs


def searched(field: CostToGo) -> int:
    """Return how many cells a search has reached."""
    return int(np.isfinite(field.costs).sum())


def costmap(cells: np.ndarray, resolution: float = CELL_M) -> Costmap2D:
    """Return a costmap at the origin."""
    cells = np.ascontiguousarray(cells, np.uint8)
    return Costmap2D(cells.shape[1], cells.shape[0], resolution, 0.0, 0.0, cells=cells)


def at(grid: Costmap2D, row: int, column: int, yaw: float = 0.0) -> Pose2D:
    """Return the pose in the middle of a cell."""
    return Pose2D(*grid.map_to_world(column, row), yaw)


def options(tolerance_m: float = 0.0, **more) -> SearchOptions:
    """Return what NavFn would ask for."""
    allow_unknown = more.pop('allow_unknown', True)
    return SearchOptions(weight_table(4.0, allow_unknown=allow_unknown), tolerance_m, **more)


def plan(planner: GridPlanner, *words) -> Route:
    """Plan at one go."""
    return finish(planner.plan(*words))


def way(search: GridSearch, *words) -> CostToGo:
    """Search at one go."""
    return finish(search.way(*words))


def plain_dijkstra(weights: np.ndarray, start: tuple[int, int], goal: tuple[int, int]) -> float:
    """Return the cost of the cheapest way, by the book."""
    import heapq

    best, queue = {start: 0.0}, [(0.0, start)]
    while queue:
        cost, cell = heapq.heappop(queue)
        if cell == goal:
            return cost
        if cost > best[cell]:
            continue
        for down in (-1, 0, 1):
            for right in (-1, 0, 1):
                there = cell[0] + down, cell[1] + right
                beside = (cell[0] + down, cell[1]), (cell[0], cell[1] + right)
                rows, columns = weights.shape
                if not (0 <= there[0] < rows and 0 <= there[1] < columns) or there == cell:
                    continue
                if math.isinf(weights[there]) or any(math.isinf(weights[b]) for b in beside):
                    continue
                found = cost + math.hypot(down, right) * 0.5 * (weights[cell] + weights[there])
                if found < best.get(there, math.inf):
                    best[there] = found
                    heapq.heappush(queue, (found, there))
    return math.inf


def pairs(grid: np.ndarray, count: int, seed: int) -> list[tuple[tuple[int, int], ...]]:
    """Return random free starts and goals."""
    random = np.random.default_rng(seed)
    free = np.argwhere(grid < 253)
    picks = free[random.integers(0, len(free), (count, 2))]
    return [(tuple(map(int, a)), tuple(map(int, b))) for a, b in picks]


@pytest.mark.parametrize('seed', range(3))
def test_cost_to_go_is_exact(seed):
    """Costs are those of Dijkstra's algorithm by the book; ways have these costs."""
    cells = rooms(90, seed)
    weights = weight_table(4.0)[cells]
    for start, goal in pairs(cells, 4, seed):
        found = cost_to_go(weights, np.isfinite(weights), goal)
        expected = plain_dijkstra(weights, start, goal)
        assert found.cost_from(start) == pytest.approx(expected, rel=1e-5)
        if math.isfinite(expected):
            cells_on_way = found.path_from(start)
            assert tuple(cells_on_way[0]) == start and tuple(cells_on_way[-1]) == goal
            assert np.abs(np.diff(cells_on_way, axis=0)).max() == 1


def test_straight_steps_only():
    """With four directions no step is diagonal."""
    weights = np.ones((20, 20), np.float32)
    found = cost_to_go(weights, weights > 0, (15, 17), diagonal=False)
    cells = found.path_from((2, 3))
    assert (np.abs(np.diff(cells, axis=0)).sum(axis=1) == 1).all()
    assert found.cost_from((2, 3)) == pytest.approx(27.0)


def test_diagonal_gap_is_closed():
    """A way does not slip between two obstacles that touch at a corner."""
    weights = np.ones((4, 4), np.float32)
    weights[[0, 1, 2, 3], [1, 1, 2, 2]] = np.inf
    assert math.isinf(cost_to_go(weights, np.isfinite(weights), (0, 3)).cost_from((0, 0)))


@pytest.mark.parametrize('seed', range(4))
def test_corridor_holds_a_way_that_is_nearly_cheapest(seed):
    """The way in the corridor costs at most 3 % more than the cheapest one."""
    cells = rooms(300, seed)
    weights = weight_table(4.0)[cells]
    free = np.isfinite(weights)
    regions = cv2.connectedComponents(free.view(np.uint8), connectivity=4)[1]
    graph = block_graph(weights, free, 8)
    extra = []
    for start, goal in pairs(cells, 6, seed):
        if regions[start] != regions[goal] or start == goal:
            continue
        best = cost_to_go(weights, free, goal).cost_from(start)
        mask = corridor(graph, start, goal, 20_000)
        extra.append(cost_to_go(weights, mask, goal).cost_from(start) / best)
    assert len(extra) >= 3
    assert max(extra) < 1.08 and sum(extra) / len(extra) < 1.03


def test_corridor_finds_a_gap_of_one_cell():
    """A door of a single cell in a thick wall is found, in any place of its block."""
    for gap in range(40, 48):
        weights = np.ones((97, 101), np.float32)
        weights[48:51] = np.inf
        weights[48:51, gap] = 1.0
        graph = block_graph(weights, np.isfinite(weights), 8)
        mask = corridor(graph, (3, 90), (90, 3), 100)
        assert math.isfinite(cost_to_go(weights, mask, (90, 3)).cost_from((3, 90)))


def test_large_grid_is_searched_in_a_corridor_at_nearly_the_same_cost():
    """Beyond the limit of exact search costs stay within a few percent."""
    cells = rooms(600, 1)
    weights = weight_table(4.0)[cells]
    search = GridSearch()
    grid = search.grid_of(weights)
    inner = np.argwhere(grid.regions == grid.regions[np.unravel_index(cells.argmin(), (600, 600))])
    start, goal = tuple(map(int, inner[0])), tuple(map(int, inner[-1]))
    found = way(search, grid, start, goal)
    exact = cost_to_go(weights, grid.region_of(start), goal)
    assert searched(found) < 0.9 * searched(exact)
    assert found.cost_from(start) < 1.03 * exact.cost_from(start)


@pytest.mark.parametrize('seed', range(3))
def test_search_in_an_ellipse_is_exact(seed):
    """Ways to near goals are the cheapest although few cells are searched; so are kept ones."""
    cells = rooms(240, seed)
    weights = weight_table(4.0)[cells]
    search = GridSearch()
    grid = search.grid_of(weights)
    spared = 0
    drawn = pairs(cells, 400, seed)
    near = [each for each in drawn if math.dist(*each) < 30.0]
    for start, goal in [*near[:5], *drawn[:3]]:
        if grid.regions[start] != grid.regions[goal]:
            continue
        exact = cost_to_go(weights, grid.region_of(start), goal)
        found = way(search, grid, start, goal)
        assert found.cost_from(start) == pytest.approx(exact.cost_from(start), rel=1e-5)
        spared += searched(found) < 0.7 * searched(exact)
        for other in (start[0] + 4, start[1]), (start[0], start[1] - 9):
            if exact.index_of(other) >= 0:
                cost = way(search, grid, other, goal).cost_from(other)
                assert cost == pytest.approx(exact.cost_from(other), rel=1e-5)
    assert spared


def test_field_is_kept_while_goal_and_costs_last():
    """A second way to the same goal needs no search; other costs do."""
    search = GridSearch()
    weights = np.ones((50, 50), np.float32)
    first = way(search, search.grid_of(weights), (1, 1), (40, 40))
    assert way(search, search.grid_of(weights.copy()), (5, 1), (40, 40)) is first
    weights = weights.copy()
    weights[3, 3] = np.inf
    assert way(search, search.grid_of(weights), (1, 1), (40, 40)) is not first


@pytest.mark.parametrize('seed', range(4))
def test_search_with_other_costs_is_exact_and_no_farther_than_the_old_way(seed):
    """A crate in the way changes the way, and the rest of the field is left out."""
    weights, search = weight_table(4.0)[rooms(160, seed)], GridSearch()
    free = np.argwhere(search.grid_of(weights).region_of((4, 4)))
    start, goal = (tuple(int(each) for each in free[at]) for at in (len(free) // 2, 20))
    old = way(search, search.grid_of(weights), start, goal).path_from(start)
    apart = np.abs(free[:, None] - old[None]).max(axis=2).min(axis=1)
    for row, column in (free[np.argmax(apart)], old[len(old) // 2]):
        changed = weights.copy()
        changed[slice(row, row + 2), slice(column, column + 2)] = np.inf
        grid = search.grid_of(changed)
        fresh = cost_to_go(changed, grid.region_of(goal), goal)
        found = way(search, grid, start, goal)
        assert found.cost_from(start) == pytest.approx(fresh.cost_from(start))
        assert way_cost(changed, found.path_from(start)) == pytest.approx(fresh.cost_from(start))
        if [row, column] not in old.tolist():
            assert searched(found) <= np.count_nonzero(
                fresh.costs <= found.cost_from(start) * 1.01
            )


def test_line_costs():
    """A line costs its length times the weights; it is blocked by cells that it touches."""
    weights = np.ones((10, 10), np.float32)
    lines = np.array(
        [[[0, 0], [0, 9]], [[0, 0], [9, 9]], [[8, 1], [2, 4]], [[5, 5], [5, 5]]], float
    )
    costs = line_costs(weights, lines[:, 0], lines[:, 1])
    assert costs == pytest.approx([9.0, 9 * math.sqrt(2.0), math.hypot(6, 3), 0.0])
    weights[3, 4] = np.inf
    blocked = np.isinf(line_costs(weights, lines[:, 0], lines[:, 1]))
    assert blocked.tolist() == [False, True, True, False]


def test_line_costs_touch_what_dense_samples_touch():
    """No blocked cell that a line passes is missed."""
    random = np.random.default_rng(3)
    weights = np.where(random.random((40, 40)) < 0.1, np.inf, 1.0).astype(np.float32)
    starts, ends = random.uniform(0, 39, (2, 300, 2))
    shares = np.linspace(0.0, 1.0, 2001)[:, None]
    found = np.isinf(line_costs(weights, starts, ends))
    for start, end, is_blocked in zip(starts, ends, found):
        cells = np.rint(start + shares * (end - start)).astype(int)
        if np.isinf(weights[cells[:, 0], cells[:, 1]]).any():
            assert is_blocked


def test_pull_taut_costs_no_more_and_is_straight_in_free_space():
    """In free space one line is left; between obstacles the cost does not rise."""
    weights = np.ones((60, 60), np.float32)
    cells = cost_to_go(weights, weights > 0, (50, 23)).path_from((3, 3))
    assert len(pull_taut(weights, cells)) == 2
    cells = rooms(200, 2)
    weights = weight_table(4.0)[cells]
    for start, goal in pairs(cells, 8, 5):
        found = cost_to_go(weights, np.isfinite(weights), goal)
        if math.isfinite(found.cost_from(start)) and start != goal:
            lines = pull_taut(weights, found.path_from(start))
            cost = line_costs(weights, lines[:-1], lines[1:]).sum()
            assert cost <= found.cost_from(start) * 1.01 + 0.1


@pytest.mark.parametrize('seed', range(4))
def test_paths_keep_off_obstacles_and_near_the_optimum(seed):
    """Random paths, rounded, pass no cell from 253 on, and cost little more than the cheapest."""
    grid = costmap(rooms(200, seed))
    planner, wanted = GridPlanner(), options()
    checked = 0
    for start, goal in pairs(grid.cells, 8, seed + 10):
        try:
            route = plan(planner, grid, at(grid, *start), at(grid, *goal), wanted)
        except PlanningError as error:
            assert error.reason == 'NO_VALID_PATH'
            exact = plain_dijkstra(wanted.table[grid.cells], start, goal)
            assert math.isinf(exact)
            continue
        points = round_corners(resample(route.corners, 1.0), route.weights, 9.0, 1.0, 2)
        places = route.to_world(resample(points, 0.2))
        assert (grid.costs_at(places) < 253).all()
        cost = line_costs(route.weights, points[:-1], points[1:]).sum() * CELL_M
        assert cost <= route.cost * 1.06 + 0.05
        assert np.hypot(*np.diff(points, axis=0).T).max() <= 1.5
        checked += 1
    assert checked >= 2


def test_maze():
    """A winding way of one cell is followed to its end."""
    cells = np.zeros((41, 41), np.uint8)
    cells[1::4, :-1] = 254
    cells[3::4, 1:] = 254
    grid = costmap(cells)
    route = plan(GridPlanner(), grid, at(grid, 0, 0), at(grid, 40, 40), options())
    assert len(resample(route.corners, 1.0)) > 20 * 40
    assert (grid.costs_at(route.to_world(resample(route.corners, 0.2))) < 253).all()


def test_unknown_space():
    """Unknown space is passed only if it is allowed, and known ways are preferred."""
    cells = np.zeros((40, 40), np.uint8)
    cells[:, 20:24] = 255
    grid = costmap(cells)
    planner, start, goal = GridPlanner(), at(grid, 20, 5), at(grid, 20, 35)
    assert plan(planner, grid, start, goal, options()).is_exact
    with pytest.raises(PlanningError, match='There is no path') as caught:
        plan(planner, grid, start, goal, options(allow_unknown=False))
    assert caught.value.reason == 'NO_VALID_PATH'
    cells[30:34, 20:24] = 0
    route = plan(planner, costmap(cells), start, goal, options())
    assert (costmap(cells).costs_at(route.to_world(resample(route.corners, 0.3))) == 0).all()
    with pytest.raises(PlanningError, match='unknown') as caught:
        plan(planner, grid, at(grid, 2, 21), goal, options(allow_unknown=False))
    assert caught.value.reason == 'START_OCCUPIED'


def test_occupied_goal_and_tolerance():
    """The path ends at the nearest cell within the tolerance; beyond it there is none."""
    cells = np.zeros((40, 40), np.uint8)
    cells[15:26, 15:26] = 254
    grid = costmap(cells)
    start, goal = at(grid, 20, 2), at(grid, 20, 20)
    route = plan(GridPlanner(), grid, start, goal, options(0.5))
    end = route.to_world(route.corners)[-1]
    assert not route.is_exact
    assert math.hypot(end[0] - goal.x, end[1] - goal.y) == pytest.approx(6 * CELL_M)
    with pytest.raises(PlanningError, match=r'in an obstacle.*0\.30 m away') as caught:
        plan(GridPlanner(), grid, start, goal, options(0.25))
    assert caught.value.reason == 'GOAL_OCCUPIED'


def test_cut_off_goal():
    """A goal behind a closed wall is NO_VALID_PATH, with the distance to where one gets."""
    cells = np.zeros((60, 60), np.uint8)
    cells[30] = 254
    grid = costmap(cells)
    with pytest.raises(PlanningError, match=r'1\.05 m away') as caught:
        plan(GridPlanner(), grid, at(grid, 5, 5), at(grid, 50, 5), options(0.5))
    assert caught.value.reason == 'NO_VALID_PATH'
    route = plan(GridPlanner(), grid, at(grid, 5, 5), at(grid, 35, 5), options(0.5))
    assert not route.is_exact and route.corners[-1].tolist() == [29.0, 5.0]


@pytest.mark.parametrize(
    ('start', 'goal', 'reason'),
    [
        (Pose2D(-1.0, 0.5, 0.0), Pose2D(0.5, 0.5, 0.0), 'START_OUTSIDE_MAP'),
        (Pose2D(0.5, 0.5, 0.0), Pose2D(5.0, 0.5, 0.0), 'GOAL_OUTSIDE_MAP'),
        (Pose2D(0.5, 0.5, 0.0), Pose2D(math.nan, 0.5, 0.0), 'GOAL_OUTSIDE_MAP'),
        (Pose2D(1.0, 1.0, 0.0), Pose2D(0.5, 0.5, 0.0), 'START_OCCUPIED'),
    ],
)
def test_start_and_goal_have_to_be_in_free_space_of_the_map(start, goal, reason):
    """Each of the errors has its code and a sentence."""
    cells = np.zeros((40, 40), np.uint8)
    cells[18:23, 18:23] = 254
    with pytest.raises(PlanningError, match=r'\.$') as caught:
        plan(GridPlanner(), costmap(cells), start, goal, options())
    assert caught.value.reason == reason


def test_robot_that_stands_too_near_a_wall_leaves_it():
    """From a cell within the inscribed radius the path leads straight out, not through walls."""
    cells = np.zeros((40, 40), np.uint8)
    cells[:, 18:25] = 253
    cells[:, 20] = 254
    grid = costmap(cells)
    route = plan(GridPlanner(), grid, at(grid, 10, 19), at(grid, 10, 5), options())
    assert route.corners[0].tolist() == [10.0, 19.0] and route.corners[1].tolist() == [10.0, 17.0]
    with pytest.raises(PlanningError):
        plan(GridPlanner(), grid, at(grid, 10, 19), at(grid, 10, 30), options())


def test_small_maps_and_start_at_the_goal():
    """A map of one cell works; a start at the goal gives one pose."""
    grid = costmap(np.zeros((1, 1)))
    route = plan(GridPlanner(), grid, at(grid, 0, 0), at(grid, 0, 0), options())
    assert len(route.corners) == 1 and route.is_exact
    near = Pose2D(0.01, 0.02, 0.0)
    route = plan(GridPlanner(), grid, near, at(grid, 0, 0), options())
    assert route.to_world(route.corners) == pytest.approx(np.array([[0.01, 0.02], [0.025, 0.025]]))


def test_ends_are_the_poses_themselves():
    """A path begins and ends at the points asked for, not at centres of cells."""
    grid = costmap(np.zeros((50, 50)))
    route = plan(GridPlanner(), grid, Pose2D(0.11, 0.13, 0.0), Pose2D(2.09, 1.97, 0.0), options())
    places = route.to_world(route.corners)
    assert places == pytest.approx(np.array([[0.11, 0.13], [2.09, 1.97]]))


def test_limits_of_effort():
    """Too many cells, or too little time, end the search with their codes."""
    grid = costmap(np.zeros((100, 100)))
    with pytest.raises(PlanningError, match='max_iterations') as caught:
        plan(GridPlanner(), grid, at(grid, 5, 5), at(grid, 90, 90), options(max_cells=100))
    assert caught.value.reason == 'NO_VALID_PATH'
    with pytest.raises(PlanningError, match='max_planning_time') as caught:
        plan(GridPlanner(), grid, at(grid, 5, 5), at(grid, 90, 90), options(max_time_s=1e-9))
    assert caught.value.reason == 'TIMEOUT'


def test_downsampled_search():
    """Larger cells keep off obstacles, too."""
    grid = costmap(rooms(200, 4))
    free = np.argwhere(grid.cells == 0)
    start, goal = at(grid, *free[0]), at(grid, *free[-1])
    route = plan(GridPlanner(), grid, start, goal, options(0.5, factor=3))
    assert route.cell_m == pytest.approx(0.15)
    assert (grid.costs_at(route.to_world(resample(route.corners, 0.1))) < 253).all()


def test_speed():
    """A map of 400 x 400 cells takes some ten milliseconds, not seconds."""
    grid = costmap(rooms(400, 7, room=80, door=20))
    free = np.argwhere(grid.cells == 0)
    planner = GridPlanner()
    start, goal = at(grid, *free[0]), at(grid, *free[-1])
    began = time.process_time()
    plan(planner, grid, start, goal, options(1.0))
    assert time.process_time() - began < 1.0


def test_resample_keeps_corners():
    """No two points are farther apart than the spacing, and corners stay."""
    points = resample(np.array([[0.0, 0.0], [0.0, 1.0], [2.0, 1.0]]), 0.3)
    assert np.hypot(*np.diff(points, axis=0).T).max() <= 0.3
    assert [0.0, 1.0] in points.tolist()


def test_smoothed_is_the_limit_of_the_iteration():
    """The solution is where p += data (p0 - p) + smooth (before + after - 2 p) comes to rest."""
    points = np.random.default_rng(0).random((30, 2))
    found = smoothed(points, 0.3, 0.2)
    middle = found[1:-1]
    rest = 0.2 * (points[1:-1] - middle) + 0.3 * (found[:-2] + found[2:] - 2.0 * middle)
    assert rest == pytest.approx(np.zeros((28, 2)), abs=1e-12)
    assert found[[0, -1]] == pytest.approx(points[[0, -1]])


def test_headings():
    """Poses face along the path; the last one as is asked for."""
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    assert headings(points) == pytest.approx([0.0, math.pi / 2, math.pi / 2, math.pi / 2])
    assert headings(points, 3.0)[-1] == 3.0
    assert headings(points[:1], 0.5).tolist() == [0.5]


def test_blend_headings():
    """A pose turns from the start's yaw to the path's and to the goal's."""
    points = np.column_stack([np.linspace(0.0, 10.0, 101), np.zeros(101)])
    yaws = blend_headings(points, np.zeros(101), 1.0, -1.0, 0.5)
    assert yaws[0] == pytest.approx(1.0) and yaws[-1] == pytest.approx(-1.0)
    assert yaws[50] == 0.0 and np.abs(np.diff(yaws)).max() < 0.25


def test_invalid_poses():
    """Poses ahead in obstacles are found; unknown space and what is behind do not count."""
    cells = np.zeros((10, 40), np.uint8)
    cells[:, 5] = cells[:, 30] = 253
    cells[:, 20] = 255
    grid = costmap(cells)
    poses = np.array([at(grid, 5, column) for column in range(40)])
    assert invalid_poses(grid, poses, None, None).tolist() == [5, 30]
    assert invalid_poses(grid, poses, None, at(grid, 5, 15)).tolist() == [30]
    square = np.array([[0.06, 0.06], [0.06, -0.06], [-0.06, -0.06], [-0.06, 0.06]])
    assert invalid_poses(grid, poses[2:38], square, None).tolist() == []
    cells[:, 30] = 254
    assert invalid_poses(grid, poses[2:38], square, None).tolist() == [27, 28, 29]
