# SPDX-License-Identifier: Apache-2.0
"""Regulated pure pursuit: steer along an arc to a lookahead point on the path."""

from __future__ import annotations

import math

from nav2_controller.control import (
    approach_angular_velocity,
    Command,
    Controller,
    ControlState,
    Displays,
    NoValidControl,
    Velocity,
)
from nav2_controller.plugins import PluginContext
from nav2_controller.tracking import transform_poses
from nav2_regulated_pure_pursuit_controller.parameters import RppParameters, UNSUPPORTED
from nav2_regulated_pure_pursuit_controller.pursuit import (
    cusp_distance,
    lookahead_point,
    regulated_speed,
)
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import angle_between, Pose2D
import numpy as np
import numpy.typing as npt

__all__ = ['RegulatedPurePursuitController']

FloatArray = npt.NDArray[np.float64]

_STANDING = 1e-3


class RegulatedPurePursuitController(Controller):
    """
    Pure pursuit controller that slows down in curves, near obstacles and at the goal.

    Source: S. Macenski, S. Singh, F. Martin, J. Gines, Regulated Pure Pursuit for Robot Path
    Tracking, Autonomous Robots 47 (2023).

    Parameters
    ----------
    context
        The name of the plugin, such as FollowPath, and where its parameters are declared.

    Raises
    ------
    ConfigurationError
        `allow_reversing` and `use_rotate_to_heading` are both true.

    """

    def __init__(self, context: PluginContext) -> None:
        self._parameters = context.declare(RppParameters)
        context.unsupported(UNSUPPORTED)
        self.search_distance_m = context.search_distance()
        self.transform_tolerance_s = context.transform_tolerance()
        self._is_at_goal = False
        self._cancel_speed: float | None = None
        current = self._parameters.current
        if current.allow_reversing and current.use_rotate_to_heading:
            raise ConfigurationError(
                f"'{context.name}.allow_reversing' and '{context.name}.use_rotate_to_heading' "
                'exclude each other: a robot that turns to its path never drives backward. '
                'Set one of them to false.'
            )

    def new_plan(self, *, is_new_goal: bool) -> None:
        """
        Set a new path.

        Parameters
        ----------
        is_new_goal
            Whether the path leads to another goal, which is not reached yet; otherwise it is a
            new path to the same goal.

        """
        self._cancel_speed = None
        if is_new_goal:
            self._is_at_goal = False

    def compute(self, state: ControlState) -> Command:
        """
        Compute the velocity command along an arc to the lookahead point, or for rotating in place.

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
            The robot would hit an obstacle, or is in collision.

        """
        parameters = self._parameters.current
        ratio = self.limit_ratio(parameters.desired_linear_vel)
        fastest = parameters.desired_linear_vel * ratio
        self._is_at_goal |= state.goal_distance_m <= state.xy_tolerance_m and (
            state.is_goal_in_plan and state.remaining_m <= 4.0 * state.xy_tolerance_m
        )
        plan = state.plan_in_base()
        carrot = self._carrot(plan, state, parameters)
        steered = carrot
        if parameters.use_fixed_curvature_lookahead:
            steered = self._point(plan, parameters.curvature_lookahead_dist, parameters)
        forward = -1.0 if parameters.allow_reversing and carrot[0] < 0.0 else 1.0
        turn = self._turn_in_place(state, carrot, parameters)
        if turn is not None:
            angular = approach_angular_velocity(
                turn,
                state.velocity.yaw,
                parameters.rotate_to_heading_angular_vel,
                parameters.max_angular_accel,
                state.period_s,
            )
            velocity = Velocity(yaw=angular)
        else:
            squared = steered[0] ** 2 + steered[1] ** 2
            curvature = 2.0 * steered[1] / squared if squared > 1e-6 else 0.0
            cost = state.surroundings.grid.cost_at(state.pose.x, state.pose.y)
            radius = state.surroundings.inscribed_radius_m
            speed = regulated_speed(
                fastest, curvature, cost, radius, state.remaining_m, parameters
            )
            velocity = Velocity(forward * speed, yaw=speed * curvature)
        arc = _arc(state, velocity, math.hypot(*carrot), parameters)
        if parameters.use_collision_detection:
            _check(state, arc)
        return Command(velocity, _displays(state, plan, carrot, steered, arc, turn is not None))

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
            The velocity along the path, decelerated by `cancel_deceleration`; None to stop at
            once.

        Raises
        ------
        NoValidControl
            As for `compute`.

        """
        parameters = self._parameters.current
        if not parameters.use_cancel_deceleration:
            return None
        if self._cancel_speed is None:
            self._cancel_speed = state.velocity.x
        step = parameters.cancel_deceleration * state.period_s
        if abs(self._cancel_speed) <= max(step, _STANDING):
            return None
        before = self._cancel_speed
        self._cancel_speed -= math.copysign(step, before)
        command = self.compute(state)
        driven = command.velocity
        curvature = driven.yaw / driven.x if abs(driven.x) > _STANDING else 0.0
        return Command(Velocity(self._cancel_speed, yaw=self._cancel_speed * curvature))

    def _carrot(
        self, plan: FloatArray, state: ControlState, parameters: RppParameters
    ) -> tuple[float, float]:
        distance = parameters.lookahead_dist
        if parameters.use_velocity_scaled_lookahead_dist:
            distance = min(
                max(
                    abs(state.velocity.x) * parameters.lookahead_time,
                    parameters.min_lookahead_dist,
                ),
                parameters.max_lookahead_dist,
            )
        if parameters.allow_reversing:
            # The robot drives to the cusp of the path before it reverses.
            distance = min(distance, max(cusp_distance(plan), 1e-3))
        return self._point(plan, distance, parameters)

    def _point(
        self, plan: FloatArray, distance: float, parameters: RppParameters
    ) -> tuple[float, float]:
        return lookahead_point(
            plan,
            distance,
            interpolate=parameters.use_interpolation,
            beyond_end=parameters.interpolate_curvature_after_goal,
        )

    def _turn_in_place(
        self, state: ControlState, carrot: tuple[float, float], parameters: RppParameters
    ) -> float | None:
        """Compute the angle to rotate in place by; None to drive."""
        if not parameters.use_rotate_to_heading:
            return None
        if self._is_at_goal:
            return angle_between(state.pose.yaw, state.goal.yaw)
        angle = math.atan2(carrot[1], carrot[0])
        return angle if abs(angle) > parameters.rotate_to_heading_min_angle else None


def _arc(
    state: ControlState, velocity: Velocity, carrot_m: float, parameters: RppParameters
) -> FloatArray:
    """Compute the (N, 3) poses of the arc at a velocity, up to the carrot."""
    horizon = parameters.max_allowed_time_to_collision_up_to_carrot
    resolution = state.surroundings.grid.resolution
    speed = abs(velocity.x)
    if speed > _STANDING:
        horizon = min(horizon, carrot_m / speed)
        count = math.ceil(horizon * speed / resolution)
    else:
        count = math.ceil(horizon * abs(velocity.yaw) / 0.1)
    times = np.linspace(0.0, horizon, min(max(count, 1), 100) + 1)
    poses = np.zeros((len(times), 3))
    poses[:, 2] = velocity.yaw * times
    if abs(velocity.yaw) > 1e-4:
        radius = velocity.x / velocity.yaw
        poses[:, 0] = radius * np.sin(poses[:, 2])
        poses[:, 1] = radius * (1.0 - np.cos(poses[:, 2]))
    else:
        poses[:, 0] = velocity.x * times
    return transform_poses(poses, state.pose)


def _check(state: ControlState, arc: FloatArray) -> None:
    hits = state.surroundings.collisions(arc)
    if hits[0]:
        raise NoValidControl(
            'The robot stands in an obstacle of the local costmap. Drive it out, or clear the '
            'costmap if nothing is there.'
        )
    if hits.any():
        x, y, _ = arc[int(np.argmax(hits))]
        raise NoValidControl(
            f'An obstacle is ahead: the robot would hit it at x {x:.2f} m, y {y:.2f} m. '
            'Plan another path.'
        )


def _displays(
    state: ControlState,
    plan: FloatArray,
    carrot: tuple[float, float],
    steered: tuple[float, float],
    arc: FloatArray,
    is_rotating: bool,
) -> Displays:
    shown = Displays(collision_arc=arc, is_rotating=is_rotating)
    point = state.pose @ Pose2D(*carrot, 0.0)
    shown.lookahead = point.x, point.y
    if steered is not carrot:
        point = state.pose @ Pose2D(*steered, 0.0)
        shown.curvature_lookahead = point.x, point.y
    return shown
