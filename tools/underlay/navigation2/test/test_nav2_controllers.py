# SPDX-License-Identifier: Apache-2.0
"""Controllers in closed loop, without ROS: an apartment, a robot that lags, and noise."""

from dataclasses import dataclass, fields, replace
import heapq
import math
import time
from types import SimpleNamespace

import cv2
from dwb_critics.motion import RotateToGoalCritic
from dwb_plugins.generators import Rollouts
from nav2_controller.control import (
    ControlState,
    NoValidControl,
    SpeedLimit,
    Surroundings,
    Velocity,
)
from nav2_controller.plugins import CONTROLLERS, PluginContext
from nav2_controller.tracking import PlanTracker
from nav2_costmap_2d.grid import Costmap2D
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import angle_between, Pose2D
from nav2_util.parameters import ParameterSet
from nav2_util.plugins import find_plugin
import numpy as np
import pytest

RESOLUTION = 0.05
RADIUS = 0.3
PERIOD = 0.05
NO_POINTS = np.empty((0, 2))
STILL = Velocity()


class PlainParameters:
    """Parameters without a node: defaults, and values by their full names."""

    def __init__(self, values=None):
        self.values = dict(values or {})
        self.unsupported = {}

    def declare(self, kind, prefix=''):
        found = {}
        for each in fields(kind):
            name = f'{prefix}.{each.metadata["spec"].name or each.name}'
            if name in self.values:
                found[each.name] = self.values[name]
        return ParameterSet(kind(**found))

    def declare_value(self, name, default, description):
        return self.values.get(name, default)

    def declare_unsupported(self, names, prefix=''):
        self.unsupported.update({f'{prefix}.{name}': why for name, why in names.items()})


def make(kind, values=None, period_s=PERIOD):
    source = PlainParameters({f'FollowPath.{k}': v for k, v in (values or {}).items()})
    context = PluginContext(source, 'FollowPath', period_s, 1.5)
    return find_plugin(CONTROLLERS, kind, 'controller')(context)


RPP = 'nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController'
DWB = 'dwb_core::DWBLocalPlanner'
MPPI = 'nav2_mppi_controller::MPPIController'
GRACEFUL = 'nav2_graceful_controller::GracefulController'
SHIM = 'nav2_rotation_shim_controller::RotationShimController'

RPP_VALUES = {
    'desired_linear_vel': 0.4,
    'lookahead_dist': 0.5,
    'rotate_to_heading_angular_vel': 0.7,
    'max_angular_accel': 1.6,
    'regulated_linear_scaling_min_radius': 0.5,
    'regulated_linear_scaling_min_speed': 0.15,
    'cost_scaling_dist': 0.45,
    'inflation_cost_scaling_factor': 4.0,
}
DWB_VALUES = {
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
    'critics': [
        'RotateToGoal',
        'Oscillation',
        'BaseObstacle',
        'GoalAlign',
        'PathAlign',
        'PathDist',
        'GoalDist',
    ],
    'BaseObstacle.scale': 0.02,
    'PathAlign.scale': 32.0,
    'GoalAlign.scale': 24.0,
    'PathDist.scale': 32.0,
    'GoalDist.scale': 24.0,
    'RotateToGoal.scale': 32.0,
    'PathAlign.forward_point_distance': 0.1,
    'GoalAlign.forward_point_distance': 0.1,
}
MPPI_VALUES = {
    'motion_model': 'Omni',
    'batch_size': 300,
    'time_steps': 30,
    'model_dt': 0.1,
    'vx_max': 0.4,
    'vx_min': -0.1,
    'vy_max': 0.2,
    'wz_max': 0.8,
    'vy_std': 0.1,
    'PathFollowCritic.cost_weight': 12.0,
    'CostCritic.cost_weight': 6.0,
}
GRACEFUL_VALUES = {
    'v_linear_max': 0.4,
    'v_angular_max': 0.8,
    'max_lookahead': 0.6,
    'slowdown_radius': 0.6,
}


@dataclass
class Robot:
    """Follows commands with a lag, within its limits."""

    pose: Pose2D
    velocity: Velocity = STILL
    lag_s: float = 0.3
    noise: float = 0.0
    limits: tuple = (0.4, 0.2, 0.8)
    rng: np.random.Generator = None

    def step(self, command, dt=PERIOD):
        now = []
        for value, wanted, limit, most in zip(
            self.velocity, command, self.limits, (0.4, 0.4, 1.6)
        ):
            wanted = min(max(wanted, -limit), limit)
            change = (wanted - value) * (1.0 - math.exp(-dt / self.lag_s))
            now.append(value + min(max(change, -most * dt), most * dt))
        self.velocity = Velocity(*now)
        shaken = now
        if self.noise:
            shaken = [v + self.rng.normal(0.0, self.noise) for v in now]
        self.pose = self.pose @ Pose2D(shaken[0] * dt, shaken[1] * dt, shaken[2] * dt)


class World:
    """A map of walls, inflated, and the part of it around a robot."""

    def __init__(self, width_m, height_m, inflation_m=0.7, scaling=4.0, size=60):
        self.walls = np.zeros((round(height_m / RESOLUTION), round(width_m / RESOLUTION)), bool)
        self.inflation_m, self.scaling, self.size = inflation_m, scaling, size
        self.wall(0, 0, width_m, RESOLUTION)
        self.wall(0, height_m - RESOLUTION, width_m, height_m)
        self.wall(0, 0, RESOLUTION, height_m)
        self.wall(width_m - RESOLUTION, 0, width_m, height_m)

    def wall(self, x0, y0, x1, y1, there=True):
        low, high = (round(y0 / RESOLUTION), round(x0 / RESOLUTION)), (y1, x1)
        rows = slice(low[0], round(high[0] / RESOLUTION))
        self.walls[rows, slice(low[1], round(high[1] / RESOLUTION))] = there
        self._cells = None

    @property
    def cells(self):
        if self._cells is None:
            away = cv2.distanceTransform((~self.walls).astype(np.uint8), cv2.DIST_L2, 5)
            away *= RESOLUTION
            self.away = away
            cost = np.floor(252 * np.exp(-self.scaling * (away - RADIUS)))
            cost[away > self.inflation_m] = 0
            cost[away <= RADIUS] = 253
            cost[self.walls] = 254
            self._cells = cost.astype(np.uint8)
        return self._cells

    def local(self, pose):
        half = self.size // 2
        column, row = round(pose.x / RESOLUTION) - half, round(pose.y / RESOLUTION) - half
        found = np.zeros((self.size, self.size), np.uint8)
        r0, c0 = max(row, 0), max(column, 0)
        r1, c1 = max(row + self.size, 0), max(column + self.size, 0)
        part = self.cells[r0:r1, c0:c1]
        r0, c0 = r0 - row, c0 - column
        r1, c1 = r0 + part.shape[0], c0 + part.shape[1]
        found[r0:r1, c0:c1] = part
        return Costmap2D(
            self.size,
            self.size,
            RESOLUTION,
            column * RESOLUTION,
            row * RESOLUTION,
            cells=found,
        )

    def clearance(self, pose):
        _ = self.cells
        return float(self.away[int(pose.y / RESOLUTION), int(pose.x / RESOLUTION)])

    def plan(self, start, goal):
        """Return a path as a planner makes it: Dijkstra over costs, smoothed."""
        cells = self.cells
        rows, columns = cells.shape
        source = int(goal.y / RESOLUTION), int(goal.x / RESOLUTION)
        target = int(start.y / RESOLUTION), int(start.x / RESOLUTION)
        best, came, queue = {source: 0.0}, {}, [(0.0, source)]
        while queue:
            cost, at = heapq.heappop(queue)
            if at == target:
                break
            if cost > best[at]:
                continue
            for dr, dc in ((0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)):
                near = at[0] + dr, at[1] + dc
                if not (0 <= near[0] < rows and 0 <= near[1] < columns) or cells[near] >= 253:
                    continue
                total = cost + math.hypot(dr, dc) * (1.0 + cells[near] / 50.0)
                if total < best.get(near, math.inf):
                    best[near], came[near] = total, at
                    heapq.heappush(queue, (total, near))
        if target not in came and target != source:
            return None
        way = [target]
        while way[-1] != source:
            way.append(came[way[-1]])
        points = (np.array(way)[:, ::-1] + 0.5) * RESOLUTION
        points[0], points[-1] = (start.x, start.y), (goal.x, goal.y)
        for _ in range(10):
            points[1:-1] = 0.5 * points[1:-1] + 0.25 * (points[:-2] + points[2:])
        yaws = np.arctan2(np.gradient(points[:, 1]), np.gradient(points[:, 0]))
        yaws[-1] = goal.yaw
        return np.column_stack([points, yaws])


@dataclass
class Outcome:
    reached: bool = False
    time_s: float = 0.0
    clearance_m: float = math.inf
    step_ms: float = 0.0
    pose: Pose2D = None
    fastest: float = 0.0
    error: str = ''
    driven_m: float = 0.0


def state_of(world, robot, tracker, now_s=0.0, goal_yaw_tolerance=0.25, velocity=None):
    grid = world.local(robot.pose)
    plan, whole = tracker.visible(Pose2D(0.0, 0.0, 0.0), grid)
    return ControlState(
        robot.pose,
        velocity or robot.velocity,
        plan,
        tracker.goal,
        whole,
        tracker.remaining_m,
        0.25,
        goal_yaw_tolerance,
        Surroundings(grid, NO_POINTS, RADIUS),
        now_s,
        PERIOD,
    )


def drive(world, controller, robot, poses, *, limit_s=120.0, yaw_tolerance=0.25, seed=0, on=None):
    """Follow a path; stop at the goal, in a collision or after some time."""
    tracker = PlanTracker(poses)
    controller.new_plan(is_new_goal=True)
    rng = np.random.default_rng(seed)
    robot.rng = rng
    outcome = Outcome()
    cpu, steps, failed = 0.0, 0, 0
    near = False
    while outcome.time_s < limit_s:
        velocity = robot.velocity
        if robot.noise:
            velocity = Velocity(*(v + rng.normal(0.0, 0.5 * robot.noise) for v in velocity))
        start = time.process_time()
        tracker.advance(robot.pose, controller.search_distance_m)
        state = state_of(world, robot, tracker, outcome.time_s, yaw_tolerance, velocity)
        try:
            command = controller.compute(state).velocity
            failed = 0
        except NoValidControl as error:
            outcome.error, command = str(error), Velocity()
            failed += 1
            if failed > 40:
                break
        cpu += time.process_time() - start
        steps += 1
        before = robot.pose
        robot.step(command)
        outcome.driven_m += before.distance_to(robot.pose)
        outcome.time_s += PERIOD
        outcome.fastest = max(outcome.fastest, robot.velocity.linear)
        outcome.clearance_m = min(outcome.clearance_m, world.clearance(robot.pose))
        if on is not None:
            on(robot, command, outcome)
        if outcome.clearance_m < RADIUS - RESOLUTION:
            outcome.error = 'collision'
            break
        near |= robot.pose.distance_to(tracker.goal) <= 0.25
        if near and abs(angle_between(robot.pose.yaw, tracker.goal.yaw)) <= yaw_tolerance:
            outcome.reached = True
            break
    outcome.pose, outcome.step_ms = robot.pose, 1e3 * cpu / max(steps, 1)
    return outcome


def apartment():
    """Return six rooms beside a corridor, with doors of 1 m and furniture."""
    world = World(9.0, 7.0)
    world.wall(0.0, 2.9, 9.0, 3.0)
    world.wall(0.0, 4.3, 9.0, 4.4)
    for x in (3.0, 6.0):
        world.wall(x, 0.0, x + 0.1, 2.9)
        world.wall(x, 4.4, x + 0.1, 7.0)
    for x in (1.0, 4.2, 7.3):
        world.wall(x, 2.9, x + 1.0, 3.0, there=False)
    for x in (1.6, 3.5, 7.0):
        world.wall(x, 4.3, x + 1.0, 4.4, there=False)
    world.wall(0.2, 0.2, 1.2, 0.8)
    world.wall(4.4, 0.8, 5.0, 1.4)
    world.wall(7.2, 5.8, 8.0, 6.4)
    world.wall(0.1, 5.9, 0.8, 6.9)
    return world


ALL = {
    'RPP': (RPP, RPP_VALUES),
    'DWB': (DWB, DWB_VALUES),
    'MPPI': (MPPI, MPPI_VALUES),
    'graceful': (GRACEFUL, GRACEFUL_VALUES),
    'shim': (
        SHIM,
        {**DWB_VALUES, 'primary_controller': DWB, 'rotate_to_heading_angular_vel': 0.7},
    ),
}


def room():
    """Return an empty room of 6 m x 4 m."""
    return World(6.0, 4.0)


def straight(start, end, yaw=0.0):
    return np.array([(*start, yaw), (*end, yaw)])


@pytest.mark.parametrize('name', list(ALL))
def test_reaches_the_goal_through_a_door(name):
    """From one room into another, through two doors of 1 m, with noise and lag."""
    world = apartment()
    start, goal = Pose2D(2.2, 1.0, 1.5), Pose2D(5.0, 6.0, 0.5)
    robot = Robot(start, noise=0.02)
    found = drive(world, make(*ALL[name]), robot, world.plan(start, goal), seed=1)
    assert found.reached, found
    assert found.clearance_m > RADIUS
    assert found.pose.distance_to(goal) < 0.3
    assert found.step_ms < 20.0


@pytest.mark.parametrize('name', ['RPP', 'DWB', 'MPPI', 'graceful'])
def test_turns_to_the_orientation_of_the_goal(name):
    """A goal whose orientation is opposite to the path is reached with it."""
    start, goal = Pose2D(1.0, 2.0, 0.0), Pose2D(3.5, 2.0, 3.0)
    poses = np.array([start, goal])
    found = drive(room(), make(*ALL[name]), Robot(start), poses, limit_s=60.0)
    assert found.reached, found
    assert abs(angle_between(found.pose.yaw, goal.yaw)) <= 0.25


@pytest.mark.parametrize('name', ['RPP', 'DWB', 'MPPI', 'graceful'])
def test_path_behind_the_robot(name):
    """A robot that faces away from its path turns, and reaches the goal."""
    start = Pose2D(4.0, 2.0, 0.0)
    poses = straight((4.0, 2.0), (1.5, 2.0), math.pi)
    found = drive(room(), make(*ALL[name]), Robot(start), poses, limit_s=90.0)
    assert found.reached, found


@pytest.mark.parametrize('name', list(ALL))
def test_wall_on_the_path_is_not_hit(name):
    """A wall that the path leads through ends in NoValidControl, or the robot stays off it."""
    world = room()
    world.wall(3.0, 0.0, 3.2, 4.0)
    found = drive(
        world,
        make(*ALL[name]),
        Robot(Pose2D(1.0, 2.0, 0.0)),
        straight((1.0, 2.0), (5.0, 2.0)),
        limit_s=30.0,
    )
    assert not found.reached
    assert found.clearance_m > RADIUS - RESOLUTION
    if name in ('RPP', 'graceful'):
        assert 'obstacle' in found.error


@pytest.mark.parametrize('name', ['DWB', 'MPPI'])
def test_box_on_the_path_is_passed(name):
    """A controller that samples goes around a small box that the path leads past."""
    world = room()
    world.wall(2.8, 1.55, 3.0, 1.75)
    poses = straight((1.0, 2.0), (5.0, 2.0))
    found = drive(world, make(*ALL[name]), Robot(Pose2D(1.0, 2.0, 0.0)), poses, limit_s=60.0)
    assert found.reached, found
    assert found.clearance_m > RADIUS


@pytest.mark.parametrize('name', list(ALL))
@pytest.mark.parametrize(
    ('limit', 'most'), [(SpeedLimit(50.0, True), 0.2), (SpeedLimit(0.15, False), 0.15)]
)
def test_speed_limit(name, limit, most):
    """A limit in percent or in m/s is kept."""
    controller = make(*ALL[name])
    controller.speed_limit = limit
    poses = straight((1.0, 2.0), (4.0, 2.0))
    found = drive(room(), controller, Robot(Pose2D(1.0, 2.0, 0.0)), poses, limit_s=6.0)
    assert 0.5 * most < found.fastest < most + 0.02


@pytest.mark.parametrize('name', ['DWB', 'MPPI'])
def test_omnidirectional_robot_goes_sideways(name):
    """A goal beside the robot is reached sideways, faster than by turning there and back."""
    values = dict(ALL[name][1])
    poses = straight((2.0, 2.0), (2.0, 2.5))
    found = drive(
        room(), make(ALL[name][0], values), Robot(Pose2D(2.0, 2.0, 0.0)), poses, limit_s=25.0
    )
    assert found.reached, found


def one_step(kind, values, poses, pose=None, velocity=STILL, world=None):
    """Return the command of a controller in one situation."""
    controller = make(kind, values)
    controller.new_plan(is_new_goal=True)
    robot = Robot(pose or Pose2D(1.0, 2.0, 0.0), velocity)
    tracker = PlanTracker(np.asarray(poses, float))
    tracker.advance(robot.pose)
    return controller.compute(state_of(world or room(), robot, tracker))


def test_rpp_steers_along_the_arc_to_the_carrot():
    """The curvature is that of the circle through the robot and the point ahead."""
    values = {
        'lookahead_dist': 0.5,
        'use_rotate_to_heading': False,
        'use_regulated_linear_velocity_scaling': False,
        'use_cost_regulated_linear_velocity_scaling': False,
        'desired_linear_vel': 0.4,
    }
    command = one_step(RPP, values, [(1.0, 2.0, 0.5), (4.0, 3.0, 0.5)])
    x, y = (a - b for a, b in zip(command.displays.lookahead, (1.0, 2.0)))
    assert math.hypot(x, y) == pytest.approx(0.5, abs=0.01)
    assert command.velocity.x == pytest.approx(0.4)
    assert command.velocity.yaw == pytest.approx(0.4 * 2.0 * y / 0.25, rel=0.05)


def test_rpp_slows_down_in_curves_near_walls_and_at_the_goal():
    """Each regulation lowers the speed, down to its minimum."""
    plain = {'desired_linear_vel': 0.5, 'use_collision_detection': False}
    far = [(1.0, 2.0, 0.0), (5.0, 2.0, 0.0)]
    assert one_step(RPP, plain, far).velocity.x == pytest.approx(0.5)
    curve = [(1.0, 2.0, 0.0), (1.3, 2.05, 0.5), (1.4, 2.6, 1.5), (1.4, 3.5, 1.5)]
    command = one_step(RPP, {**plain, 'rotate_to_heading_min_angle': 2.0}, curve)
    assert command.velocity.x == pytest.approx(0.25)
    near = [(1.0, 0.45, 0.0), (5.0, 0.45, 0.0)]
    assert one_step(RPP, plain, near, Pose2D(1.0, 0.45, 0.0)).velocity.x < 0.49
    end = one_step(RPP, plain, [(1.0, 2.0, 0.0), (1.3, 2.0, 0.0)])
    assert end.velocity.x == pytest.approx(0.25, abs=0.02)


def test_rpp_scales_its_lookahead_with_the_speed():
    """The point ahead is farther away for a faster robot, within limits."""
    values = {'use_velocity_scaled_lookahead_dist': True}
    far = [(1.0, 2.0, 0.0), (5.0, 2.0, 0.0)]
    for speed, expected in ((0.0, 0.3), (0.4, 0.6), (2.0, 0.9)):
        command = one_step(RPP, values, far, velocity=Velocity(speed))
        assert command.displays.lookahead[0] - 1.0 == pytest.approx(expected, abs=0.01)


def test_rpp_drives_backward_where_the_path_does():
    """With allow_reversing a path behind the robot is followed backward."""
    values = {'allow_reversing': True, 'use_rotate_to_heading': False}
    command = one_step(RPP, values, [(3.0, 2.0, 0.0), (1.0, 2.0, 0.0)], Pose2D(3.0, 2.0, 0.0))
    assert command.velocity.x < -0.2


def test_rpp_slows_down_after_a_cancel():
    """With use_cancel_deceleration the speed falls step by step to zero."""
    values = {'use_cancel_deceleration': True, 'cancel_deceleration': 1.0}
    controller = make(RPP, values)
    controller.new_plan(is_new_goal=True)
    robot = Robot(Pose2D(1.0, 2.0, 0.0), Velocity(0.4))
    tracker = PlanTracker(straight((1.0, 2.0), (5.0, 2.0)))
    speeds = []
    while (command := controller.cancel(state_of(room(), robot, tracker))) is not None:
        speeds.append(command.velocity.x)
    assert speeds[0] == pytest.approx(0.35)
    assert speeds == sorted(speeds, reverse=True)
    assert 5 <= len(speeds) <= 8


def test_dwb_says_what_its_critics_object_to():
    """In a dead end the message counts the objections of each critic."""
    world = room()
    world.wall(1.2, 0.0, 1.3, 4.0)
    with pytest.raises(NoValidControl, match=r'hit an obstacle.*BaseObstacle'):
        one_step(DWB, DWB_VALUES, straight((1.0, 2.0), (5.0, 2.0)), world=world)


def test_dwb_with_limited_accelerations_tries_only_what_a_period_allows():
    """Its command differs from the velocity by no more than the accelerations in a period."""
    values = {**DWB_VALUES, 'trajectory_generator_name': 'dwb_plugins::LimitedAccelGenerator'}
    command = one_step(
        DWB, values, straight((1.0, 2.0), (5.0, 2.0)), velocity=Velocity(0.2, 0.0, 0.0)
    )
    assert command.velocity.x == pytest.approx(0.2 + 0.4 * PERIOD, abs=1e-3)


def test_dwb_keeps_a_polygon_off_obstacles():
    """What the outline of a long robot would hit is refused by ObstacleFootprint."""
    footprint = np.array([(0.5, 0.2), (0.5, -0.2), (-0.5, -0.2), (-0.5, 0.2)])
    world = room()
    world.wall(1.9, 0.0, 2.0, 4.0)
    critics = ['ObstacleFootprint', 'GoalDist', 'PathDist']
    controller = make(DWB, {**DWB_VALUES, 'critics': critics})
    robot = Robot(Pose2D(1.0, 2.0, 0.0))
    tracker = PlanTracker(straight((1.0, 2.0), (5.0, 2.0)))
    for _ in range(100):
        state = state_of(world, robot, tracker)
        around = Surroundings(state.surroundings.grid, footprint, 0.2)
        assert not around.collisions(np.array([robot.pose])).any()
        robot.step(controller.compute(replace(state, surroundings=around)).velocity)
    assert 1.1 < robot.pose.x < 1.7


@pytest.mark.parametrize(
    ('kind', 'values', 'words'),
    [
        (DWB, {'max_vel_x': 0.2}, 'critics'),
        (DWB, {**DWB_VALUES, 'critics': ['PathDists']}, "mean 'PathDist'"),
        (DWB, {**DWB_VALUES, 'trajectory_generator_name': 'x'}, 'trajectory generator'),
        (DWB, {**DWB_VALUES, 'GoalDist.aggregation_type': 'mean'}, 'aggregation_type'),
        (MPPI, {'critics': ['GoalCritik']}, "mean 'GoalCritic'"),
        (SHIM, {}, 'primary_controller'),
        (GRACEFUL, {'allow_backward': True}, 'exclude each other'),
    ],
)
def test_wrong_parameters(kind, values, words):
    """What cannot work is refused with a sentence."""
    with pytest.raises(ConfigurationError, match=words):
        make(kind, values)


def test_shim_turns_first_and_then_leaves_it_to_its_controller():
    """It turns in place until the path is ahead, and to the goal's orientation at the end."""
    values = {**ALL['shim'][1], 'rotate_to_goal_heading': True}
    seen = []
    start = Pose2D(1.0, 1.0, -1.5)
    drive(
        room(),
        make(SHIM, values),
        Robot(start),
        straight((1.0, 1.0), (3.0, 3.0), 0.8),
        on=lambda robot, command, _: seen.append((robot.pose, command)),
    )
    turning = [command for pose, command in seen if abs(pose.yaw - 0.785) > 0.5]
    assert all(command.x == 0.0 and command.yaw > 0.0 for command in turning)
    assert max(command.x for _, command in seen) > 0.3


def test_mppi_is_repeatable_and_obeys_its_limits():
    """The same seed leads to the same command; no command is beyond the limits."""
    poses = straight((1.0, 2.0), (5.0, 2.0))
    first, second = (one_step(MPPI, MPPI_VALUES, poses) for _ in range(2))
    assert first.velocity == second.velocity
    seen = []
    drive(
        room(),
        make(MPPI, {**MPPI_VALUES, 'motion_model': 'DiffDrive'}),
        Robot(Pose2D(1.0, 2.0, 1.0)),
        poses,
        limit_s=5.0,
        on=lambda _, command, __: seen.append(command),
    )
    assert max(command.x for command in seen) <= 0.4 + 1e-6
    assert max(abs(command.yaw) for command in seen) <= 0.8 + 1e-6
    assert not any(command.y for command in seen)


def test_mppi_gives_up_when_everything_collides():
    """A robot in a corner of obstacles has no control."""
    world = room()
    world.wall(0.8, 1.8, 1.2, 2.2)
    with pytest.raises(NoValidControl, match='trajectories hit'):
        one_step(MPPI, MPPI_VALUES, straight((1.0, 2.0), (5.0, 2.0)), world=world)


def test_tracker_follows_a_loop_without_a_shortcut():
    """On a path that crosses itself the nearest pose is looked for near the last one."""
    angles = np.linspace(0.0, 2.0 * math.pi, 100)
    loop = np.column_stack([np.sin(angles), 1.0 - np.cos(angles), angles])
    tracker = PlanTracker(loop)
    tracker.advance(Pose2D(0.0, 0.0, 0.0), 1.0)
    assert tracker.remaining_m > 6.0
    for angle in angles[::5]:
        tracker.advance(Pose2D(math.sin(angle), 1.0 - math.cos(angle), angle), 1.0)
    assert tracker.remaining_m < 0.4


def test_tracker_makes_sparse_paths_dense_and_cuts_them_at_the_costmap():
    """Two poses 10 m apart become many, of which those in the costmap are visible."""
    tracker = PlanTracker(straight((1.0, 2.0), (11.0, 2.0)))
    assert len(tracker.poses) == 201
    grid = Costmap2D(60, 60, RESOLUTION, 0.0, 0.0)
    plan, whole = tracker.visible(Pose2D(0.0, 0.0, 0.0), grid)
    assert not whole
    assert plan[0, 0] == pytest.approx(1.0)
    assert 2.9 < plan[-1, 0] < 3.0


@pytest.mark.parametrize(
    ('lookahead_s', 'at_rad'), [(-1.0, 0.8), (0.0, 0.2), (0.5, 0.2), (1.1, 0.4), (9.0, 0.8)]
)
def test_dwb_heading_at_a_time_of_the_trajectory(lookahead_s, at_rad):
    """RotateToGoal takes the yaw of the point that is nearest in time, or the last one."""
    source = PlainParameters({'RotateToGoal.lookahead_time': lookahead_s})
    critic = RotateToGoalCritic(PluginContext(source, 'RotateToGoal', PERIOD, 1.5))
    state = SimpleNamespace(
        is_goal_in_plan=True,
        goal_distance_m=0.0,
        velocity=Velocity(0.5),
        goal=Pose2D(0.0, 0.0, 0.0),
    )
    times_s = np.array([0.5, 1.0, 1.5, 2.0], np.float32)
    still = np.zeros((1, 4), np.float32)
    yaw = 0.4 * times_s[None, :]
    rollouts = Rollouts(np.zeros((1, 3), np.float32), still, still, yaw, times_s)
    scene = SimpleNamespace(state=state, rollouts=rollouts)
    critic.begin(scene)
    assert critic.scores(scene) == pytest.approx([at_rad], abs=1e-6)
