# SPDX-License-Identifier: Apache-2.0
"""The interface of controllers: what they are told and return, and their base class."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
import math
from typing import NamedTuple

import cv2
from nav2_costmap_2d.costs import INSCRIBED_INFLATED_OBSTACLE, LETHAL_OBSTACLE, NO_INFORMATION
from nav2_costmap_2d.footprint import FootprintCollisionChecker
from nav2_costmap_2d.grid import Costmap2D
from nav2_util.errors import NavigationError
from nav2_util.geometry import Pose2D
from nav2_util.twist import Velocity
import numpy as np
import numpy.typing as npt

__all__ = [
    'Command',
    'ControlState',
    'Controller',
    'Displays',
    'NoValidControl',
    'SpeedLimit',
    'Surroundings',
    'Velocity',
    'approach_angular_velocity',
]

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


class NoValidControl(NavigationError):
    """A controller finds no collision-free velocity along the path; the message states why."""


class SpeedLimit(NamedTuple):
    """Speed limit: a fraction of the configured speed, or m/s."""

    value: float
    is_percentage: bool

    def ratio(self, configured_speed: float) -> float:
        """
        Convert the limit to a fraction of a configured speed.

        Parameters
        ----------
        configured_speed
            The maximum speed without the limit, in m/s.

        Returns
        -------
        float
            From 0 to 1.

        """
        if self.is_percentage:
            return min(max(self.value / 100.0, 0.0), 1.0)
        return min(max(self.value / configured_speed, 0.0), 1.0) if configured_speed > 0.0 else 1.0


class Surroundings:
    """
    Collision checker with the costmap around a robot, and its footprint.

    Parameters
    ----------
    grid
        The costmap, in the frame of the poses to check.
    footprint
        (N, 2) corners in m in the base frame; empty for a circular robot, of which the centre is
        checked.
    inscribed_radius_m
        The radius of a circular robot, or the inscribed radius of the footprint.

    """

    def __init__(self, grid: Costmap2D, footprint: FloatArray, inscribed_radius_m: float) -> None:
        self.grid, self.footprint = grid, footprint
        self.inscribed_radius_m = inscribed_radius_m
        self._checker = FootprintCollisionChecker(grid)

    @property
    def is_circular(self) -> bool:
        """Whether only the cost at the centre of the robot is checked."""
        return not len(self.footprint)

    @cached_property
    def clearance(self) -> npt.NDArray[np.float32]:
        """Distance in m from each cell to the nearest obstacle cell, in the shape of the grid."""
        free = (self.grid.cells != LETHAL_OBSTACLE).astype(np.uint8)
        if free.all():
            return np.full(free.shape, 1e3, np.float32)
        found = cv2.distanceTransform(free, cv2.DIST_L2, 5)
        return np.asarray(found * np.float32(self.grid.resolution), np.float32)

    def collisions(self, poses: FloatArray) -> BoolArray:
        """
        Find the poses at which the robot is in collision; off the costmap it never is.

        Parameters
        ----------
        poses
            (M, 3) array of x, y (m) and yaw (rad).

        Returns
        -------
        (M,) array.

        """
        poses = np.asarray(poses, float).reshape(-1, 3)
        costs = self.grid.costs_at(poses[:, :2], outside=NO_INFORMATION)
        hits: BoolArray = np.equal(costs, LETHAL_OBSTACLE)
        if self.is_circular:
            hits |= costs == INSCRIBED_INFLATED_OBSTACLE
        else:
            hits |= self._outline_collisions(poses, ~hits)
        return hits

    def _outline_collisions(self, poses: FloatArray, asked: BoolArray) -> BoolArray:
        """Check the outlines at poses close enough to an obstacle for a collision."""
        reach = float(np.hypot(*self.footprint.T).max()) + 1.5 * self.grid.resolution
        cells = self.grid.world_to_map_array(poses[:, :2])
        size = np.array([self.grid.size_x, self.grid.size_y])
        # The outline of a robot whose centre is off the costmap may reach into it.
        inside = ((cells >= 0) & (cells < size)).all(axis=1)
        clear = np.zeros(len(poses), bool)
        columns, rows = cells[inside].T
        clear[inside] = self.clearance[rows, columns] > reach
        found = np.zeros(len(poses), bool)
        near = np.flatnonzero(asked & ~clear & inside)
        if len(near):
            costs = self._checker.footprint_costs(poses[near], self.footprint)
            off = self._leaves_grid(poses[near])
            found[near] = (costs == LETHAL_OBSTACLE) & ~off
            for index in near[off]:
                found[index] = self._touches_inside(poses[index])
        return found

    def _leaves_grid(self, poses: FloatArray) -> BoolArray:
        reach = float(np.hypot(*self.footprint.T).max())
        low = np.array([self.grid.origin_x, self.grid.origin_y]) + reach
        high = low + (self.grid.size_x_m - 2 * reach, self.grid.size_y_m - 2 * reach)
        beyond: BoolArray = (poses[:, :2] < low) | (poses[:, :2] > high)
        return beyond[:, 0] | beyond[:, 1]

    def _touches_inside(self, pose: FloatArray) -> bool:
        cos, sin = np.cos(pose[2]), np.sin(pose[2])
        points = self.footprint @ np.array([[cos, sin], [-sin, cos]]) + pose[:2]
        ends = np.roll(points, -1, axis=0)
        parts = np.linspace(0.0, 1.0, 12)[:, None, None]
        outline = (points + parts * (ends - points)).reshape(-1, 2)
        return bool((self.grid.costs_at(outline, outside=NO_INFORMATION) == LETHAL_OBSTACLE).any())


@dataclass(frozen=True)
class ControlState:
    """State of one control period; all poses are in the frame of the costmap."""

    pose: Pose2D
    velocity: Velocity
    plan: FloatArray
    """(N, 3) poses of the path from the one nearest to the robot to the edge of the costmap."""
    goal: Pose2D
    is_goal_in_plan: bool
    """Whether `plan` reaches the goal."""
    remaining_m: float
    """The remaining length of the path."""
    xy_tolerance_m: float
    """The position tolerance of the goal."""
    yaw_tolerance_rad: float
    surroundings: Surroundings
    now_s: float
    """The time of the node's clock, for differences."""
    period_s: float
    """The duration of a control period."""

    @property
    def goal_distance_m(self) -> float:
        """Return the straight-line distance to the goal."""
        return self.pose.distance_to(self.goal)

    def plan_in_base(self) -> FloatArray:
        """Transform the (N, 3) plan to the base frame."""
        cos, sin = math.cos(self.pose.yaw), math.sin(self.pose.yaw)
        moved = self.plan - self.pose
        turned = np.array(moved)
        turned[:, 0] = cos * moved[:, 0] + sin * moved[:, 1]
        turned[:, 1] = cos * moved[:, 1] - sin * moved[:, 0]
        return turned


@dataclass
class Displays:
    """What a controller displays, in the frame of the costmap; None: nothing."""

    local_plan: FloatArray | None = None
    """(N, 3) predicted poses of the robot."""
    lookahead: tuple[float, float] | None = None
    curvature_lookahead: tuple[float, float] | None = None
    collision_arc: FloatArray | None = None
    """(N, 3) poses that were checked for collisions."""
    motion_target: Pose2D | None = None
    slowdown_radius_m: float | None = None
    trajectories: FloatArray | None = None
    """(K, T, 2) positions of candidate trajectories."""
    is_rotating: bool | None = None


@dataclass(frozen=True)
class Command:
    """A velocity command, and its displays."""

    velocity: Velocity
    displays: Displays = field(default_factory=Displays)


class Controller:
    """
    Base class of controllers, which compute a velocity in each control period.

    Subclasses override `compute`, and `new_plan` if they are stateful. Their constructor accepts a
    `nav2_controller.plugins.PluginContext` and declares their parameters.
    """

    speed_limit: SpeedLimit | None = None
    """The current speed limit; None: no limit besides the configured speeds."""
    transform_tolerance_s: float = 0.0
    """The maximum age of the robot's pose, if larger than that of the server."""
    search_distance_m: float = math.inf
    """The distance along the path within which the nearest pose is searched for."""

    def new_plan(self, *, is_new_goal: bool) -> None:
        """
        Set a new path.

        Parameters
        ----------
        is_new_goal
            Whether the path leads to another goal; otherwise it is a new path to the same one.

        """

    def compute(self, state: ControlState) -> Command:
        """
        Compute the velocity for the next period.

        Parameters
        ----------
        state
            The robot, its path and its surroundings in this period.

        Raises
        ------
        NoValidControl
            There is no valid velocity.

        """
        raise NotImplementedError

    def cancel(self, state: ControlState) -> Command | None:
        """
        Decelerate after the goal was canceled; called in each period until it returns None.

        Parameters
        ----------
        state
            The robot, its path and its surroundings in this period.

        Returns
        -------
        Command or None
            The velocity for the next period; None to stop at once.

        """
        return None

    def limit_ratio(self, configured_speed: float) -> float:
        """
        Compute the fraction of a configured speed that the speed limit allows, from 0 to 1.

        Parameters
        ----------
        configured_speed
            The maximum speed without a limit, in m/s.

        """
        return 1.0 if self.speed_limit is None else self.speed_limit.ratio(configured_speed)


def approach_angular_velocity(
    angle_rad: float,
    current: float,
    fastest: float,
    acceleration: float,
    period_s: float,
    slowest: float = 0.0,
) -> float:
    """
    Compute the angular velocity for rotating in place, such that the robot can stop at the target.

    Parameters
    ----------
    angle_rad
        The remaining angle.
    current, fastest, slowest
        The angular velocity now, and the limits of its magnitude, in rad/s.
    acceleration
        The limit of its change in rad/s^2.
    period_s
        The time until the next command.

    """
    braking = math.sqrt(2.0 * acceleration * abs(angle_rad))
    wanted = math.copysign(max(min(fastest, braking), slowest), angle_rad)
    step = acceleration * period_s
    return min(max(wanted, current - step), current + step)
