# SPDX-License-Identifier: Apache-2.0
"""Single requests to the parts of navigation, each as an action without arguments."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from ament_index_python import get_package_share_directory
from builtin_interfaces.msg import Time
from nav2_amcl.localizer import Localizer, LocalizerSettings
from nav2_amcl.occupancy_map import OccupancyMap, RayCaster
from nav2_amcl.particle_filter import FilterOptions
from nav2_amcl.scan_projection import Scan
from nav2_controller.control import ControlState, Surroundings, Velocity
from nav2_controller.plugins import CONTROLLERS, PluginContext
from nav2_controller.tracking import PlanTracker
from nav2_costmap_2d.grid import Costmap2D
from nav2_costmap_2d.inflation_layer import Inflation
from nav2_costmap_2d.regions import Region
from nav2_msgs.action import ComputePathToPose
from nav2_planner.global_planner import finish, GlobalPlanner, PLANNERS
from nav2_smoother.smoothers import SMOOTHERS
from nav2_util.geometry import make_path, Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.plugins import find_plugin
import numpy as np
import numpy.typing as npt
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from slam_toolbox_py.loop_closure import close_loops
from slam_toolbox_py.mapper import Mapper
from slam_toolbox_py.scans import take_scan

__all__ = [
    'PARAMETERS',
    'PLANNED_CELLS',
    'control_step',
    'house',
    'localization',
    'mapping',
    'planning',
    'smoothing',
]

Action = Callable[[], object]

PARAMETERS = str(
    Path(get_package_share_directory('humanoid_navigation'), 'config', 'nav2_params.yaml')
)
PLANNED_CELLS = {400: 60.0, 2000: 400.0}
"""The side lengths of the planned maps, and the time limits in ms."""
CELL_M = 0.05
RADIUS_M = 0.28
PERIOD_S = 0.05
ANGLES = np.radians(np.arange(360.0) - 180.0)
KINDS = {
    'RPP': 'nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController',
    'DWB': 'dwb_core::DWBLocalPlanner',
    'MPPI': 'nav2_mppi_controller::MPPIController',
}
VALUES: dict[str, dict[str, Any]] = {
    'DWB': {
        'min_vel_x': -0.1,
        'max_vel_x': 0.4,
        'min_vel_y': -0.2,
        'max_vel_y': 0.2,
        'max_vel_theta': 0.8,
        'max_speed_xy': 0.4,
        'acc_lim_x': 0.4,
        'acc_lim_y': 0.4,
        'acc_lim_theta': 1.0,
        'decel_lim_x': -0.4,
        'decel_lim_y': -0.4,
        'decel_lim_theta': -1.0,
        'vx_samples': 9,
        'vy_samples': 9,
        'vtheta_samples': 15,
        'critics': ['RotateToGoal', 'Oscillation', 'BaseObstacle', 'GoalAlign', 'PathAlign']
        + ['PathDist', 'GoalDist'],
    },
    'MPPI, large': {'batch_size': 1000, 'time_steps': 56, 'model_dt': 0.05},
}


def house(side: int, room: int = 80, door: int = 20) -> Costmap2D:
    """
    Build a square costmap of rooms with doors, with furniture and inflation.

    Parameters
    ----------
    side
        Its side length in cells of 0.05 m.
    room, door
        The distance between walls, and the width of the doors, in cells.

    """
    random = np.random.default_rng(7)
    cells = np.zeros((side, side), np.uint8)
    for at in [*range(0, side - 1, room), side - 2]:
        cells[at : at + 2] = cells[:, at : at + 2] = 254
    for at in range(room, side - 2, room):
        for along in range(0, side - room + 1, room):
            for grid in (cells, cells.T):
                gap = along + int(random.integers(3, room - door - 2))
                grid[gap : gap + door, at : at + 2] = 0
    for _ in range(side * side // 1600):
        row, column = random.integers(2, side - 5, 2)
        if not cells[max(row - 9, 0) : row + 12, max(column - 9, 0) : column + 12].any():
            cells[row : row + 3, column : column + 3] = 254
    grid = Costmap2D(side, side, CELL_M, 0.0, 0.0, cells=cells)
    Inflation(0.6, RADIUS_M, 4.0).apply(grid, Region.whole(grid))
    return grid


def planning(grid: Costmap2D) -> tuple[Action, Action, Action]:
    """
    Prepare requests for a path from corner to corner of a map.

    Parameters
    ----------
    grid
        The costmap, which is not changed.

    Returns
    -------
    Action, Action, Action
        Plan to a fresh goal, to the same goal again, and to that goal after a cost has changed.

    """
    node = _node('planner_server')
    far_m = grid.size_x * CELL_M - 1.5
    start, goal = Pose2D(1.5, 1.5, 0.0), Pose2D(far_m, far_m, 0.0)
    costmap: Any = SimpleNamespace(grid=grid)

    def make() -> GlobalPlanner:
        kind = 'nav2_navfn_planner::NavfnPlanner'
        planner: GlobalPlanner = find_plugin(PLANNERS, kind, 'planner')(node, 'GridBased', costmap)
        return planner

    def plan(planner: GlobalPlanner, to: Pose2D) -> object:
        """Plan as the server does, including the serialization of the response."""
        poses = finish(planner.create_plan(start, to))
        path = make_path(poses, 'map', Time())
        return serialize_message(ComputePathToPose.Result(path=path))

    planner = make()

    def fresh() -> object:
        nonlocal planner
        planner = make()
        return plan(planner, goal)

    def changed() -> object:
        costmap.grid = grid.copy()
        costmap.grid.cells[2, 2 + next(places)] = 252
        return plan(planner, goal)

    places = iter(range(grid.size_x - 4))
    return fresh, lambda: plan(planner, goal), changed


def smoothing() -> dict[str, Action]:
    """Prepare requests to the smoothers for a path with a corner."""
    x = np.minimum(np.arange(400), 200) * CELL_M
    y = np.maximum(np.arange(400) - 200, 0) * CELL_M
    poses = np.column_stack([x + 5.0, y + 5.0, np.zeros(400)])
    grid = Costmap2D(400, 400, CELL_M, 0.0, 0.0)
    node = _node('smoother_server')
    names = ('SimpleSmoother', 'SavitzkyGolaySmoother')
    made = [find_plugin(SMOOTHERS, f'nav2_smoother::{name}', 'smoother') for name in names]
    return {name: partial(kind(node, name).smooth, poses, grid) for name, kind in zip(names, made)}


def control_step(name: str) -> Action:
    """
    Prepare a control step beside a wall, in a local costmap of 60 x 60 cells.

    Parameters
    ----------
    name
        A key of `KINDS`, optionally with a suffix after a comma; `VALUES` may have its parameters.

    Returns
    -------
    Action
        Tracks the path and computes a velocity.

    """
    kind = name.partition(',')[0]
    node = _node(
        'controller_server', {f'FollowPath.{k}': v for k, v in VALUES.get(name, {}).items()}
    )
    context = PluginContext(node.parameters, 'FollowPath', PERIOD_S, 1.5)
    controller = find_plugin(CONTROLLERS, KINDS[kind], 'controller')(context)
    cells = np.zeros((60, 60), np.uint8)
    cells[45:47, 5:] = cells[:12, 40:42] = 254
    grid = Costmap2D(60, 60, CELL_M, -1.5, -1.5, cells=cells)
    Inflation(0.6, RADIUS_M, 4.0).apply(grid, Region.whole(grid))
    ahead = np.arange(80) * CELL_M
    tracker = PlanTracker(np.column_stack([ahead, 0.1 * np.sin(ahead), np.zeros(80)]))
    controller.new_plan(is_new_goal=True)

    def step() -> object:
        robot = Pose2D(0.0, 0.02, 0.05)
        tracker.advance(robot, controller.search_distance_m)
        plan, whole = tracker.visible(Pose2D(0.0, 0.0, 0.0), grid)
        around = Surroundings(grid, np.empty((0, 2)), RADIUS_M)
        goal, left_m = tracker.goal, tracker.remaining_m
        speed = Velocity(0.3, 0.0, 0.0)
        state = ControlState(
            robot, speed, plan, goal, whole, left_m, 0.25, 0.25, around, 0.0, PERIOD_S
        )
        return controller.compute(state)

    return step


def localization(particles: int) -> Action:
    """
    Prepare an update of AMCL in a house.

    Parameters
    ----------
    particles
        The number of particles of the filter.

    Returns
    -------
    Action
        Updates the filter with a scan of 360 ranges.

    """
    found, caster = _scanned_house()
    options = FilterOptions(min_particles=particles, max_particles=particles)
    localizer = Localizer(LocalizerSettings(filter_options=options), np.random.default_rng(1))
    localizer.set_map(found)
    localizer.start_at(Pose2D(2.0, 2.0, 0.0))
    scan = Scan(_ranges(caster, (2.0, 2.0)), -math.pi, math.radians(1.0), 0.1, 12.0)

    def update() -> object:
        localizer.force_update()
        return localizer.observe(scan, np.eye(3), np.array([2.0, 2.0, 1.0]), Pose2D(2, 2, 0.0))

    return update


def mapping() -> Action:
    """Prepare adding a further scan to a map, including the search for loops."""
    _, caster = _scanned_house()
    mapper = Mapper()
    number = 0

    def add() -> object:
        nonlocal number
        place = 1.3 + 1.4 * (1.0 - math.cos(number * 0.2)), 2.0 + 0.5 * math.sin(number * 0.2)
        scan = take_scan(_ranges(caster, place), ANGLES, np.eye(3), np.zeros(3), 0.1, 12.0)
        number += 1
        mapper.add(scan, np.array([*place, 0.0]))
        return list(close_loops(mapper, len(mapper.keyframes) - 1))

    for _ in range(60):
        add()
    return add


def _scanned_house() -> tuple[OccupancyMap, RayCaster]:
    cells = np.where(house(220).cells == 254, 100, 0).astype(np.int8)
    found = OccupancyMap(cells, CELL_M, (0.0, 0.0, 0.0))
    return found, RayCaster(found)


def _ranges(caster: RayCaster, place: tuple[float, float]) -> npt.NDArray[np.float64]:
    return caster.cast(np.array([place]), ANGLES, 12.0)


def _node(name: str, values: dict[str, Any] | None = None) -> LifecycleNode:
    """Create a node with the humanoid's parameters, and further ones."""
    overrides = [Parameter(key, value=value) for key, value in (values or {}).items()]
    words = ['--ros-args', '--params-file', PARAMETERS]
    return LifecycleNode(name, cli_args=words, parameter_overrides=overrides)
