# SPDX-License-Identifier: Apache-2.0
"""The graceful controller: smooth arcs to target poses ahead on the path."""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_controller.control import (
    Command,
    Controller,
    ControlState,
    Displays,
    NoValidControl,
    Velocity,
)
from nav2_controller.plugins import PluginContext
from nav2_controller.tracking import path_lengths, transform_poses
from nav2_graceful_controller.smooth_control_law import SmoothControlLaw
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import angle_between, Pose2D, wrap_angle
from nav2_util.parameters import parameter
import numpy as np
import numpy.typing as npt

__all__ = ['GracefulController']

FloatArray = npt.NDArray[np.float64]

_TARGETS = 5


_UNSUPPORTED = {
    'motion_target_dist': 'the target is between min_lookahead and max_lookahead',
    'final_rotation': 'set prefer_final_rotation',
    'initial_rotation_min_angle': 'set initial_rotation_tolerance',
    'v_linear_max_initial': 'v_linear_max holds from the start',
    'v_angular_max_initial': 'v_angular_max holds from the start',
}


@dataclass(frozen=True)
class GracefulParameters:
    """The parameters of the graceful controller."""

    min_lookahead: float = parameter(
        0.25, 'The least distance in m of the pose that is the target.', low=0.0
    )
    max_lookahead: float = parameter(
        1.0, 'The largest distance in m of the pose that is the target.', low=0.0
    )
    k_phi: float = parameter(
        2.0, 'How fast the robot turns to the line through the target; k1 of the paper.', low=0.0
    )
    k_delta: float = parameter(
        1.0, 'How fast the error of its heading vanishes; k2 of the paper.', low=0.0
    )
    beta: float = parameter(0.4, 'How much curvature slows down.', low=0.0)
    lambda_: float = parameter(
        2.0, 'The power of the curvature that slows down.', low=0.0, name='lambda'
    )
    v_linear_min: float = parameter(0.1, 'The lowest speed in m/s.', low=0.0)
    v_linear_max: float = parameter(0.5, 'The highest speed in m/s.', low=0.0)
    v_angular_max: float = parameter(1.0, 'The highest angular velocity in rad/s.', low=0.0)
    v_angular_min_in_place: float = parameter(
        0.25, 'The lowest angular velocity in rad/s when turning in place.', low=0.0
    )
    slowdown_radius: float = parameter(
        1.5, 'The distance in m from the goal within which to slow down.', low=0.0
    )
    initial_rotation: bool = parameter(
        True, 'Whether to turn to the path in place before the robot sets off.'
    )
    initial_rotation_tolerance: float = parameter(
        0.75, 'The angle in rad to the path below which it sets off.', low=0.0
    )
    prefer_final_rotation: bool = parameter(
        True, 'Whether to turn in place at the goal, rather than on the way to it.'
    )
    rotation_scaling_factor: float = parameter(
        0.5, 'The angular velocity per angle when turning in place, per v_angular_max.', low=0.0
    )
    allow_backward: bool = parameter(
        False, 'Whether to drive backward where the path leads backward.'
    )
    in_place_collision_resolution: float = parameter(
        0.1, 'The angle in rad between poses that are checked when turning in place.', low=0.01
    )
    use_collision_detection: bool = parameter(True, 'Whether to avoid collisions.')


class GracefulController(Controller):
    """
    Controller that follows a smooth control law to the farthest collision-free pose of the path.

    Source: J. J. Park, B. Kuipers, A Smooth Control Law for Graceful Motion of Differential
    Wheeled Mobile Robots in 2D Environment, ICRA 2011.

    Parameters
    ----------
    context
        The name of the plugin, such as FollowPath, and where its parameters are declared.

    Raises
    ------
    ConfigurationError
        `initial_rotation` and `allow_backward` are both true.

    """

    def __init__(self, context: PluginContext) -> None:
        self._parameters = context.declare(GracefulParameters)
        context.unsupported(_UNSUPPORTED)
        self.search_distance_m = context.search_distance()
        self.transform_tolerance_s = context.transform_tolerance()
        self._has_set_off = self._is_at_goal = False
        current = self._parameters.current
        if current.initial_rotation and current.allow_backward:
            raise ConfigurationError(
                f"'{context.name}.initial_rotation' and '{context.name}.allow_backward' exclude "
                'each other: a robot that turns to its path never drives backward. '
                'Set one of them to false.'
            )

    def new_plan(self, *, is_new_goal: bool) -> None:
        """
        Set a new path.

        Parameters
        ----------
        is_new_goal
            Whether the path leads to another goal, towards which the robot may first rotate in
            place; otherwise it is a new path to the same goal.

        """
        if is_new_goal:
            self._has_set_off = self._is_at_goal = False

    def compute(self, state: ControlState) -> Command:
        """
        Compute the velocity command along a smooth arc to a pose of the path.

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
            The robot would hit an obstacle on all arcs to poses within the lookahead distance, or
            when it rotates in place.

        """
        p = self._parameters.current
        ratio = self.limit_ratio(p.v_linear_max)
        self._is_at_goal |= state.goal_distance_m <= state.xy_tolerance_m and (
            state.is_goal_in_plan and state.remaining_m <= 4.0 * state.xy_tolerance_m
        )
        if self._is_at_goal and p.prefer_final_rotation:
            angle = angle_between(state.pose.yaw, state.goal.yaw)
            return self._turn(state, angle, p)
        plan = _with_orientations(state.plan_in_base(), state, p)
        lengths = path_lengths(plan)
        for index in _targets(plan, lengths, p):
            target = Pose2D(*map(float, plan[index]))
            heading = math.atan2(target.y, target.x)
            backward = p.allow_backward and abs(heading) > 0.5 * math.pi
            if p.initial_rotation and not self._has_set_off:
                if abs(heading) > p.initial_rotation_tolerance:
                    return self._turn(state, heading, p)
                self._has_set_off = True
            law = _law(p, ratio, state)
            way = law.simulate(target, state.surroundings.grid.resolution, 0.05, backward=backward)
            poses = transform_poses(way, state.pose)
            if p.use_collision_detection and state.surroundings.collisions(poses).any():
                continue
            v, w = law.velocity(target, backward=backward)
            shown = Displays(
                local_plan=poses,
                motion_target=state.pose @ target,
                slowdown_radius_m=p.slowdown_radius,
            )
            return Command(Velocity(v, yaw=w), shown)
        raise NoValidControl(
            'Every way to a pose of the path within the lookahead distance hits an obstacle. '
            'Plan another path.'
        )

    def _turn(self, state: ControlState, angle: float, p: GracefulParameters) -> Command:
        """Rotate in place by an angle in rad."""
        count = max(math.ceil(abs(angle) / p.in_place_collision_resolution), 1)
        poses = np.tile(np.array(state.pose), (count + 1, 1))
        poses[:, 2] += np.linspace(0.0, angle, count + 1)
        if p.use_collision_detection and state.surroundings.collisions(poses).any():
            raise NoValidControl('The robot would hit an obstacle when it turns in place.')
        w = p.rotation_scaling_factor * angle * p.v_angular_max
        w = math.copysign(min(max(abs(w), p.v_angular_min_in_place), p.v_angular_max), angle)
        return Command(Velocity(yaw=w), Displays(local_plan=poses, is_rotating=True))


def _law(p: GracefulParameters, ratio: float, state: ControlState) -> SmoothControlLaw:
    v_max = p.v_linear_max * ratio
    # Only slow down for the goal, not for each intermediate target.
    near = state.is_goal_in_plan and state.remaining_m < p.slowdown_radius
    if near and p.slowdown_radius > 0.0:
        v_max = max(v_max * state.remaining_m / p.slowdown_radius, min(p.v_linear_min, v_max))
    return SmoothControlLaw(
        k_phi=p.k_phi,
        k_delta=p.k_delta,
        beta=p.beta,
        lambda_=p.lambda_,
        v_min=min(p.v_linear_min, v_max),
        v_max=v_max,
        w_max=p.v_angular_max,
    )


def _targets(plan: FloatArray, lengths: FloatArray, p: GracefulParameters) -> list[int]:
    """Return the candidate target poses, the farthest one first."""
    away = np.hypot(plan[:, 0], plan[:, 1])
    beyond = np.flatnonzero(away > p.max_lookahead)
    last = int(beyond[0]) - 1 if len(beyond) else len(plan) - 1
    last = max(last, 0)
    first = int(np.searchsorted(lengths, p.min_lookahead))
    if first >= last:
        return [last]
    chosen = np.unique(np.linspace(first, last, _TARGETS).astype(int))
    return [int(each) for each in chosen[::-1]]


def _with_orientations(plan: FloatArray, state: ControlState, p: GracefulParameters) -> FloatArray:
    """Orient (N, 3) poses along the path, unless driving backward is allowed."""
    if p.allow_backward or len(plan) < 2:
        return plan
    steps = np.diff(plan[:, :2], axis=0)
    turned = np.array(plan)
    turned[:-1, 2] = np.arctan2(steps[:, 1], steps[:, 0])
    if not state.is_goal_in_plan or p.prefer_final_rotation:
        turned[-1, 2] = turned[-2, 2]
    else:
        turned[-1, 2] = wrap_angle(state.goal.yaw - state.pose.yaw)
    return turned
