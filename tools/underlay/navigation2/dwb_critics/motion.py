# SPDX-License-Identifier: Apache-2.0
"""Critics of DWB that score how the robot moves, regardless of its position."""

from __future__ import annotations

from dataclasses import dataclass
import math

from dwb_critics.critic import Critic, illegal, Scene
from dwb_plugins.generators import Floats
from nav2_controller.control import Velocity
from nav2_controller.plugins import PluginContext
from nav2_util.geometry import angle_between, Pose2D
from nav2_util.parameters import parameter
import numpy as np
import numpy.typing as npt

__all__ = ['OscillationCritic', 'PreferForwardCritic', 'RotateToGoalCritic', 'TwirlingCritic']

BoolArray = npt.NDArray[np.bool_]
_ZERO = 1e-3


@dataclass(frozen=True)
class RotateToGoalParameters:
    """The parameters of RotateToGoalCritic."""

    xy_goal_tolerance: float = parameter(
        0.25, 'The distance in m from the goal where the robot turns to it.', low=0.0
    )
    trans_stopped_velocity: float = parameter(
        0.25, 'The speed in m/s below which the robot counts as stopped.', low=0.0
    )
    slowing_factor: float = parameter(5.0, 'How much the speed counts while it stops.', low=0.0)
    lookahead_time: float = parameter(
        -1.0, 'The time in s on the trajectory when its yaw counts; below 0: the end.'
    )


@dataclass(frozen=True)
class OscillationParameters:
    """The parameters of OscillationCritic."""

    oscillation_reset_dist: float = parameter(
        0.05, 'The distance in m after which any direction is allowed again.'
    )
    oscillation_reset_angle: float = parameter(0.2, 'Or the angle in rad.')
    oscillation_reset_time: float = parameter(-1.0, 'Or the time in s; below 0: never.')
    x_only_threshold: float = parameter(
        0.05, 'The velocity along x in m/s above which y and theta may oscillate.'
    )


@dataclass(frozen=True)
class PreferForwardParameters:
    """The parameters of PreferForwardCritic."""

    penalty: float = parameter(1.0, 'The score of what is not forward.')
    strafe_x: float = parameter(0.1, 'The velocity along x in m/s below which it is not.')
    strafe_theta: float = parameter(
        0.2, 'The angular velocity in rad/s above which it is none the less.'
    )
    theta_scale: float = parameter(10.0, 'How much the angular velocity counts.')


class RotateToGoalCritic(Critic):
    """
    Critic that makes the robot stop near the goal, and then only rotate to the goal's heading.

    Parameters
    ----------
    context
        The name of the critic, which is the prefix of its parameters.

    """

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        self._parameters = context.declare(RotateToGoalParameters)
        self._is_near = self._is_turning = False

    def reset(self) -> None:
        """Reset the state for a new goal."""
        self._is_near = self._is_turning = False

    def begin(self, scene: Scene) -> None:
        """
        Update whether the robot is near the goal, and whether it has stopped and only rotates.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        """
        state, p = scene.state, self._parameters.current
        self._is_near |= state.is_goal_in_plan and state.goal_distance_m <= p.xy_goal_tolerance
        stopped = state.velocity.linear <= p.trans_stopped_velocity
        self._is_turning = self._is_near and (self._is_turning or stopped)

    def scores(self, scene: Scene) -> Floats:
        """
        Score the heading error at the goal, and the speed until the robot has stopped.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        Returns
        -------
        numpy.ndarray
            Heading errors in rad plus weighted speeds (S,), 0 far from the goal; infinite for
            velocities that do not slow down, or that translate while the robot is to rotate in
            place.

        """
        rollouts, state = scene.rollouts, scene.state
        if not self._is_near:
            return np.zeros(len(rollouts), np.float32)
        p = self._parameters.current
        speed = np.hypot(rollouts.velocities[:, 0], rollouts.velocities[:, 1])
        at = -1
        if p.lookahead_time >= 0.0:
            at = int(np.abs(rollouts.times_s - p.lookahead_time).argmin())
        turn = np.float32(state.goal.yaw) - rollouts.yaw[:, at]
        scores = np.abs(np.remainder(turn + np.float32(math.pi), 2 * math.pi) - math.pi)
        scores = scores.astype(np.float32)
        if self._is_turning:
            return illegal(scores, speed > _ZERO)
        faster = speed >= max(state.velocity.linear, _ZERO)
        return illegal(scores + np.float32(p.slowing_factor) * speed, faster)

    def objection(self) -> str:
        """Describe why trajectories are illegal."""
        return 'do not stop and turn at the goal'


class _Trend:
    """Signs of one component of the chosen velocities."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Reset the state for a new goal."""
        self.last, self.only = 0, 0

    def regard(self, value: float) -> bool:
        """Record a velocity; return whether its sign has changed."""
        sign = (value > _ZERO) - (value < -_ZERO)
        flipped = sign != 0 and sign == -self.last
        if flipped:
            self.only = sign
        self.last = sign or self.last
        return flipped

    def opposed(self, values: Floats) -> BoolArray:
        return np.asarray(values * np.float32(self.only) < -_ZERO)


class OscillationCritic(Critic):
    """
    Critic that rejects oscillations: velocities that reverse again right after a reversal.

    Parameters
    ----------
    context
        The name of the critic, which is the prefix of its parameters.

    """

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        self._parameters = context.declare(OscillationParameters)
        self._x, self._y, self._theta = _Trend(), _Trend(), _Trend()
        self._start: tuple[Pose2D, float] | None = None
        self._here = Pose2D(0.0, 0.0, 0.0), 0.0

    def reset(self) -> None:
        """Reset the state for a new goal."""
        for trend in (self._x, self._y, self._theta):
            trend.reset()
        self._start = None

    def begin(self, scene: Scene) -> None:
        """
        Allow all directions again after enough translation, rotation or time.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        """
        self._here = scene.state.pose, scene.state.now_s
        if self._start is not None and self._has_left(*self._start):
            self.reset()

    def scores(self, scene: Scene) -> Floats:
        """
        Reject velocities opposed to the direction of the last reversal.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        Returns
        -------
        numpy.ndarray
            Zeros (S,); infinite for velocities that would reverse again.

        """
        velocities = scene.rollouts.velocities
        wrong = (
            self._x.opposed(velocities[:, 0])
            | self._y.opposed(velocities[:, 1])
            | self._theta.opposed(velocities[:, 2])
        )
        return illegal(np.zeros(len(velocities), np.float32), wrong)

    def debrief(self, velocity: Velocity) -> None:
        """
        Record the signs of the chosen velocity; a reversal restarts the distance and the timer.

        Parameters
        ----------
        velocity
            The velocity in the base frame; y and yaw are only considered while x is slow.

        """
        flipped = self._x.regard(velocity.x)
        if abs(velocity.x) <= self._parameters.current.x_only_threshold:
            flipped |= self._y.regard(velocity.y)
            flipped |= self._theta.regard(velocity.yaw)
        if flipped:
            self._start = self._here

    def objection(self) -> str:
        """Describe why trajectories are illegal."""
        return 'turn back at once'

    def _has_left(self, pose: Pose2D, time_s: float) -> bool:
        p, (here, now_s) = self._parameters.current, self._here
        return (
            (p.oscillation_reset_dist >= 0.0 and pose.distance_to(here) > p.oscillation_reset_dist)
            or (
                p.oscillation_reset_angle >= 0.0
                and abs(angle_between(pose.yaw, here.yaw)) > p.oscillation_reset_angle
            )
            or (p.oscillation_reset_time >= 0.0 and now_s - time_s > p.oscillation_reset_time)
        )


class PreferForwardCritic(Critic):
    """
    Critic that penalises backward and lateral motion, and rotation.

    Parameters
    ----------
    context
        The name of the critic, which is the prefix of its parameters.

    """

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        self._parameters = context.declare(PreferForwardParameters)

    def scores(self, scene: Scene) -> Floats:
        """
        Score backward and lateral motion by the penalty, and other motion by its rotation.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        Returns
        -------
        numpy.ndarray
            Scores (S,), none infinite.

        """
        p, velocities = self._parameters.current, scene.rollouts.velocities
        turn = np.abs(velocities[:, 2])
        strafes = (velocities[:, 0] < p.strafe_x) & (turn < p.strafe_theta)
        penalized = strafes | (velocities[:, 0] < 0.0)
        scores = np.where(penalized, np.float32(p.penalty), turn * np.float32(p.theta_scale))
        return np.asarray(scores, np.float32)


class TwirlingCritic(Critic):
    """Critic that penalises rotation, for robots that can move sideways."""

    default_scale = 0.0

    def scores(self, scene: Scene) -> Floats:
        """
        Score the angular speed of trajectories.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        Returns
        -------
        numpy.ndarray
            Magnitudes of the angular velocities (S,) in rad/s.

        """
        return np.asarray(np.abs(scene.rollouts.velocities[:, 2]), np.float32)
