# SPDX-License-Identifier: Apache-2.0
"""What a controller is given in each period, what it returns, and how it refuses."""

from __future__ import annotations

from dataclasses import dataclass, field
import math
from typing import NamedTuple

from nav2_controller.surroundings import Surroundings
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
    'Velocity',
    'approach_angular_velocity',
]

FloatArray = npt.NDArray[np.float64]


class NoValidControl(NavigationError):
    """A controller finds no velocity that is safe and follows the path; says why."""


class SpeedLimit(NamedTuple):
    """The highest speed that is allowed: a part of the configured one, or m/s."""

    value: float
    is_percentage: bool

    def ratio(self, configured_speed: float) -> float:
        """
        Convert the limit to a part of a configured speed.

        Parameters
        ----------
        configured_speed
            The highest speed without the limit, in m/s.

        Returns
        -------
        float
            From 0 to 1.

        """
        if self.is_percentage:
            return min(max(self.value / 100.0, 0.0), 1.0)
        return min(max(self.value / configured_speed, 0.0), 1.0) if configured_speed > 0.0 else 1.0


@dataclass(frozen=True)
class ControlState:
    """What a controller knows in one period; all poses are in the frame of the costmap."""

    pose: Pose2D
    velocity: Velocity
    plan: FloatArray
    """(N, 3) poses of the path from the one nearest to the robot to the end of the costmap."""
    goal: Pose2D
    is_goal_in_plan: bool
    """Whether `plan` reaches the goal."""
    remaining_m: float
    """The length of the path that is still to be followed."""
    xy_tolerance_m: float
    """How near to the goal is near enough."""
    yaw_tolerance_rad: float
    surroundings: Surroundings
    now_s: float
    """Time of the node's clock, for differences."""
    period_s: float
    """The duration of a control period."""

    @property
    def goal_distance_m(self) -> float:
        """Return the distance to the goal in a straight line."""
        return self.pose.distance_to(self.goal)

    def plan_in_base(self) -> FloatArray:
        """Return the (N, 3) plan in the base frame."""
        cos, sin = math.cos(self.pose.yaw), math.sin(self.pose.yaw)
        moved = self.plan - self.pose
        turned = np.array(moved)
        turned[:, 0] = cos * moved[:, 0] + sin * moved[:, 1]
        turned[:, 1] = cos * moved[:, 1] - sin * moved[:, 0]
        return turned


@dataclass
class Displays:
    """What a controller wants to be seen, in the frame of the costmap; None: nothing."""

    local_plan: FloatArray | None = None
    """(N, 3) poses that the robot is expected to pass."""
    lookahead: tuple[float, float] | None = None
    curvature_lookahead: tuple[float, float] | None = None
    collision_arc: FloatArray | None = None
    """(N, 3) poses that were checked for collisions."""
    motion_target: Pose2D | None = None
    slowdown_radius_m: float | None = None
    trajectories: FloatArray | None = None
    """(K, T, 2) positions of candidates."""
    is_rotating: bool | None = None


@dataclass(frozen=True)
class Command:
    """A velocity, and what leads to it."""

    velocity: Velocity
    displays: Displays = field(default_factory=Displays)


class Controller:
    """
    The base of controllers: computes a velocity in each period.

    Subclasses override `compute`, and `new_plan` if they remember something. They are made with
    `nav2_controller.plugins.PluginContext` and declare their parameters then.
    """

    speed_limit: SpeedLimit | None = None
    """The limit that holds now; None: what is configured."""
    transform_tolerance_s: float = 0.0
    """How old the pose of the robot may be, if that is more than the server allows."""
    search_distance_m: float = math.inf
    """How far along the path the pose nearest to the robot is searched."""

    def new_plan(self, *, is_new_goal: bool) -> None:
        """
        Follow another path from now on.

        Parameters
        ----------
        is_new_goal
            Whether it leads elsewhere; otherwise it is a correction of the way.

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
            There is none.

        """
        raise NotImplementedError

    def cancel(self, state: ControlState) -> Command | None:
        """
        Slow down after the goal was canceled; called in each period until it returns None.

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
        Return the part of a configured speed that the speed limit allows now, from 0 to 1.

        Parameters
        ----------
        configured_speed
            The highest speed without a limit, in m/s.

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
    Return the angular velocity for turning in place by an angle, such that it can stop there.

    Parameters
    ----------
    angle_rad
        What is left to turn.
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
