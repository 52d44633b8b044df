# SPDX-License-Identifier: Apache-2.0
"""The rotation shim: rotates in place towards a new path, then uses another controller."""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_controller.control import (
    approach_angular_velocity,
    Command,
    Controller,
    ControlState,
    Displays,
    NoValidControl,
    SpeedLimit,
    Velocity,
)
from nav2_controller.plugins import CONTROLLERS, PluginContext
from nav2_controller.tracking import path_lengths
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import angle_between
from nav2_util.parameters import parameter
from nav2_util.plugins import find_plugin
import numpy as np

__all__ = ['RotationShimController']

_NAME = 'nav2_rotation_shim_controller::RotationShimController'


@dataclass(frozen=True)
class ShimParameters:
    """The parameters of the rotation shim."""

    angular_dist_threshold: float = parameter(
        0.785, 'The angle in rad to a new path above which to turn in place.', low=0.0
    )
    angular_disengage_threshold: float = parameter(
        0.3925, 'The angle in rad below which turning ends.', low=0.0
    )
    forward_sampling_distance: float = parameter(
        0.5, 'The distance in m of the pose of the path to turn to.', low=0.0
    )
    rotate_to_heading_angular_vel: float = parameter(
        1.8, 'The angular velocity in rad/s for turning in place.', low=0.0
    )
    max_angular_accel: float = parameter(
        3.2, 'The angular acceleration in rad/s^2 for turning in place.', low=0.0
    )
    simulate_ahead_time: float = parameter(
        1.0, 'How far ahead in s collisions are looked for.', low=0.0
    )
    primary_controller: str = parameter('', 'The type of the controller that follows the path.')
    rotate_to_goal_heading: bool = parameter(
        False, 'Whether to turn in place to the orientation of the goal, too.'
    )
    rotate_to_heading_once: bool = parameter(
        False, 'Whether to turn only for a new goal, and not for each new path.'
    )
    closed_loop: bool = parameter(
        True, 'Whether accelerations start at the measured velocity, or at the last command.'
    )
    use_path_orientations: bool = parameter(
        False, "Whether to turn to the pose's own orientation."
    )


class RotationShimController(Controller):
    """
    Controller that rotates in place towards a new path, then uses its primary controller.

    The parameters of the primary controller have the same prefix as those of the shim.

    Parameters
    ----------
    context
        The name of the plugin, such as FollowPath, and where its parameters and those of the
        primary controller are declared.

    Raises
    ------
    ConfigurationError
        `primary_controller` is not the type of another controller.

    """

    def __init__(self, context: PluginContext) -> None:
        self._parameters = context.declare(ShimParameters)
        wanted = self._parameters.current.primary_controller
        if not wanted or wanted.replace('/', '::') == _NAME:
            raise ConfigurationError(
                f"The parameter '{context.name}.primary_controller' must be the type of "
                "another controller, such as 'dwb_core::DWBLocalPlanner'."
            )
        self._primary: Controller = find_plugin(CONTROLLERS, wanted, 'controller')(context)
        self.search_distance_m = self._primary.search_distance_m
        self.transform_tolerance_s = self._primary.transform_tolerance_s
        self._is_new = self._is_turning = self._is_at_goal = False
        self._last = Velocity()

    @property
    def speed_limit(self) -> SpeedLimit | None:
        """Return the speed limit of the primary controller."""
        return self._primary.speed_limit

    @speed_limit.setter
    def speed_limit(self, limit: SpeedLimit | None) -> None:
        """
        Set the speed limit of the primary controller.

        Parameters
        ----------
        limit
            The new limit; None: no limit besides the configured speeds.

        """
        self._primary.speed_limit = limit

    def new_plan(self, *, is_new_goal: bool) -> None:
        """
        Set a new path, towards which the robot may first rotate in place.

        Parameters
        ----------
        is_new_goal
            Whether the path leads to another goal; a new path to the same goal triggers no
            rotation if `rotate_to_heading_once` is true.

        """
        if is_new_goal or not self._parameters.current.rotate_to_heading_once:
            self._is_new = True
        if is_new_goal:
            self._is_turning = self._is_at_goal = False
        self._primary.new_plan(is_new_goal=is_new_goal)

    def compute(self, state: ControlState) -> Command:
        """
        Compute the velocity command for rotating in place, or that of the primary controller.

        Parameters
        ----------
        state
            The robot, its path and the costmap in this control period.

        Returns
        -------
        Command
            The velocity in the base frame (m/s, rad/s), and what to display.

        Raises
        ------
        NoValidControl
            The robot would hit an obstacle when it rotates in place, or the primary controller
            finds no velocity.

        """
        command = self._turn(state) or self._primary.compute(state)
        self._last = command.velocity
        return command

    def cancel(self, state: ControlState) -> Command | None:
        """
        Compute the decelerating command after the goal was canceled.

        Parameters
        ----------
        state
            As for `compute`.

        Returns
        -------
        Command or None
            That of the primary controller; None to stop at once.

        """
        return self._primary.cancel(state)

    def _turn(self, state: ControlState) -> Command | None:
        """Compute the command for rotating in place; None to follow the path."""
        p = self._parameters.current
        self._is_at_goal |= state.is_goal_in_plan and (
            state.goal_distance_m <= state.xy_tolerance_m
            and state.remaining_m <= 4.0 * state.xy_tolerance_m
        )
        if p.rotate_to_goal_heading and self._is_at_goal:
            return self._command(state, angle_between(state.pose.yaw, state.goal.yaw))
        if not self._is_new:
            return None
        angle = self._angle_to_path(state, p)
        limit = p.angular_disengage_threshold if self._is_turning else p.angular_dist_threshold
        if angle is None or abs(angle) <= limit:
            self._is_new = self._is_turning = False
            return None
        self._is_turning = True
        return self._command(state, angle)

    def _angle_to_path(self, state: ControlState, p: ShimParameters) -> float | None:
        lengths = path_lengths(state.plan)
        index = int(np.searchsorted(lengths, p.forward_sampling_distance))
        if index >= len(state.plan):
            if not state.is_goal_in_plan or len(state.plan) < 2:
                return None
            index = len(state.plan) - 1
        x, y, yaw = (float(each) for each in state.plan[index])
        if p.use_path_orientations:
            return angle_between(state.pose.yaw, yaw)
        return angle_between(state.pose.yaw, math.atan2(y - state.pose.y, x - state.pose.x))

    def _command(self, state: ControlState, angle: float) -> Command:
        p = self._parameters.current
        current = state.velocity if p.closed_loop else self._last
        w = approach_angular_velocity(
            angle,
            current.yaw,
            p.rotate_to_heading_angular_vel,
            p.max_angular_accel,
            state.period_s,
        )
        turn = min(abs(w) * p.simulate_ahead_time, abs(angle))
        poses = np.tile(np.array(state.pose), (max(math.ceil(turn / 0.1), 1) + 1, 1))
        poses[:, 2] += np.linspace(0.0, math.copysign(turn, w), len(poses))
        if state.surroundings.collisions(poses).any():
            raise NoValidControl('The robot would hit an obstacle when it turns in place.')
        return Command(Velocity(yaw=w), Displays(local_plan=poses, is_rotating=True))
