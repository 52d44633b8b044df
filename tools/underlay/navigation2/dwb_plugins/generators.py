# SPDX-License-Identifier: Apache-2.0
"""Trajectory generators of DWB: sample velocities and simulate their trajectories, vectorized."""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_controller.control import Velocity
from nav2_controller.plugins import PluginContext
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import Pose2D
from nav2_util.parameters import parameter, Unsupported
import numpy as np
import numpy.typing as npt

__all__ = [
    'GeneratorParameters',
    'LimitedAccelGenerator',
    'Rollouts',
    'StandardTrajectoryGenerator',
    'make_generator',
]

Floats = npt.NDArray[np.float32]

_MOST_POINTS = 24
_UNSUPPORTED = {
    'angular_granularity': Unsupported(
        'all trajectories have the same number of points, by linear_granularity, at most '
        f'{_MOST_POINTS}',
        (0.025,),
    ),
}


@dataclass(frozen=True)
class GeneratorParameters:
    """The parameters of the trajectory generators."""

    min_vel_x: float = parameter(0.0, 'The lowest velocity along x in m/s.')
    min_vel_y: float = parameter(0.0, 'The lowest velocity along y in m/s.')
    max_vel_x: float = parameter(0.0, 'The highest velocity along x in m/s.')
    max_vel_y: float = parameter(0.0, 'The highest velocity along y in m/s.')
    max_vel_theta: float = parameter(0.0, 'The highest angular velocity in rad/s.', low=0.0)
    min_speed_xy: float = parameter(0.0, 'The lowest speed in m/s, unless the robot turns.')
    max_speed_xy: float = parameter(0.0, 'The highest speed in m/s; below 0: no limit.')
    min_speed_theta: float = parameter(
        0.0, 'The lowest angular velocity in rad/s of a robot that drives slower than that.'
    )
    acc_lim_x: float = parameter(0.0, 'The acceleration along x in m/s^2.')
    acc_lim_y: float = parameter(0.0, 'The acceleration along y in m/s^2.')
    acc_lim_theta: float = parameter(0.0, 'The angular acceleration in rad/s^2.')
    decel_lim_x: float = parameter(0.0, 'The deceleration along x in m/s^2, negative.')
    decel_lim_y: float = parameter(0.0, 'The deceleration along y in m/s^2, negative.')
    decel_lim_theta: float = parameter(0.0, 'The angular deceleration in rad/s^2, negative.')
    vx_samples: int = parameter(20, 'The number of velocities along x.', low=1)
    vy_samples: int = parameter(5, 'The number of velocities along y.', low=1)
    vtheta_samples: int = parameter(20, 'The number of angular velocities.', low=1)
    sim_time: float = parameter(1.7, 'How far ahead in s each velocity is tried.', low=0.01)
    discretize_by_time: bool = parameter(
        False, 'Whether time_granularity says how many points a trajectory has.'
    )
    time_granularity: float = parameter(0.5, 'The time in s between two points.', low=0.001)
    linear_granularity: float = parameter(0.5, 'The distance in m between two points.', low=0.001)
    include_last_point: bool = parameter(
        True, 'Whether trajectories have a point at the end of the time.'
    )


@dataclass(frozen=True)
class Rollouts:
    """The trajectories of S velocities, at T times."""

    velocities: Floats
    """(S, 3) along x and y in m/s, and in rad/s."""
    x: Floats
    """(S, T) in m, in the frame of the costmap."""
    y: Floats
    yaw: Floats
    """(S, T) in rad, not wrapped."""
    times_s: Floats
    """(T,) from now, in s."""

    def __len__(self) -> int:
        return len(self.velocities)


class StandardTrajectoryGenerator:
    """
    Generator that samples all velocities reachable within the simulated time.

    Source: D. Fox, W. Burgard, S. Thrun, The Dynamic Window Approach to Collision Avoidance, IEEE
    Robotics and Automation Magazine 4 (1997).

    Parameters
    ----------
    context
        The controller's name, which is the prefix of its parameters.

    Raises
    ------
    ConfigurationError
        All velocity limits are 0, so that the robot cannot move.

    """

    accelerates = True
    """Whether the robot accelerates towards the velocity, or has it immediately."""

    def __init__(self, context: PluginContext) -> None:
        self._parameters = context.declare(GeneratorParameters)
        context.unsupported(_UNSUPPORTED)
        self._resolution_m = 0.05
        current = self._parameters.current
        if current.max_vel_x <= 0.0 and current.max_vel_y <= 0.0 and current.max_vel_theta <= 0.0:
            raise ConfigurationError(
                f"With '{context.name}.max_vel_x', '{context.name}.max_vel_y' and "
                f"'{context.name}.max_vel_theta' of 0 the robot cannot move. Set them to what "
                'it is capable of.'
            )

    @property
    def fastest(self) -> float:
        """Return the highest configured speed in m/s."""
        current = self._parameters.current
        if current.max_speed_xy > 0.0:
            return current.max_speed_xy
        return math.hypot(current.max_vel_x, current.max_vel_y)

    def window_s(self) -> float:
        """Return the time in s within which a velocity has to be reachable."""
        return self._parameters.current.sim_time

    def velocities(self, now: Velocity, ratio: float = 1.0) -> Floats:
        """
        Sample velocities.

        Parameters
        ----------
        now
            The current velocity of the robot.
        ratio
            The allowed fraction of the speed limits, from 0 to 1.

        Returns
        -------
        (S, 3) velocities.

        """
        p, window = self._parameters.current, self.window_s()
        rows = (
            (now.x, p.min_vel_x, p.max_vel_x, p.acc_lim_x, p.decel_lim_x, p.vx_samples),
            (now.y, p.min_vel_y, p.max_vel_y, p.acc_lim_y, p.decel_lim_y, p.vy_samples),
            (
                now.yaw,
                -p.max_vel_theta,
                p.max_vel_theta,
                p.acc_lim_theta,
                p.decel_lim_theta,
                p.vtheta_samples,
            ),
        )
        axes = [
            _samples(v, low * ratio, high * ratio, up * window, abs(down) * window, count)
            for v, low, high, up, down, count in rows
        ]
        grid = np.meshgrid(*axes, indexing='ij')
        found = np.stack([axis.ravel() for axis in grid], axis=1)
        speed, turn = np.hypot(found[:, 0], found[:, 1]), np.abs(found[:, 2])
        kept = (speed >= p.min_speed_xy - 1e-6) | (turn >= p.min_speed_theta - 1e-6)
        if p.min_speed_xy <= 0.0 and p.min_speed_theta <= 0.0:
            kept[:] = True
        if p.max_speed_xy >= 0.0:
            kept &= speed <= p.max_speed_xy * ratio + 1e-4
        return found[kept] if kept.any() else np.zeros((1, 3), np.float32)

    def rollouts(self, pose: Pose2D, now: Velocity, velocities: Floats) -> Rollouts:
        """
        Simulate the trajectories of velocities.

        Parameters
        ----------
        pose, now
            The robot in the frame of the costmap, and its velocity.
        velocities
            (S, 3) velocities to try.

        """
        p = self._parameters.current
        count = self._count(velocities)
        times = np.arange(1, count + 1, dtype=np.float32) * np.float32(p.sim_time / count)
        if not p.include_last_point and count > 1:
            times = times[:-1]
        dt = times[0]
        if self.accelerates:
            reached = [
                _approach(now[k], velocities[:, k], up * times, abs(down) * times)
                for k, (up, down) in enumerate(
                    (
                        (p.acc_lim_x, p.decel_lim_x),
                        (p.acc_lim_y, p.decel_lim_y),
                        (p.acc_lim_theta, p.decel_lim_theta),
                    )
                )
            ]
            yaw = np.float32(pose.yaw) + np.cumsum(reached[2], axis=1) * dt
            middle = yaw - reached[2] * np.float32(0.5 * dt)
            vx, vy = reached[0] * dt, reached[1] * dt
        else:
            turn = velocities[:, 2:3]
            yaw = np.float32(pose.yaw) + turn * times
            middle = yaw - turn * np.float32(0.5 * dt)
            vx, vy = velocities[:, 0:1] * dt, velocities[:, 1:2] * dt
        cos, sin = np.cos(middle), np.sin(middle)
        x = np.float32(pose.x) + np.cumsum(vx * cos - vy * sin, axis=1)
        y = np.float32(pose.y) + np.cumsum(vx * sin + vy * cos, axis=1)
        return Rollouts(velocities, x, y, yaw, times)

    def _count(self, velocities: Floats) -> int:
        p = self._parameters.current
        if p.discretize_by_time:
            count = math.ceil(p.sim_time / p.time_granularity)
        else:
            speed = float(np.hypot(velocities[:, 0], velocities[:, 1]).max())
            count = math.ceil(speed * p.sim_time / min(p.linear_granularity, self._resolution_m))
        return min(max(count, 4), _MOST_POINTS)


class LimitedAccelGenerator(StandardTrajectoryGenerator):
    """
    Generator that samples only velocities reachable within a control period.

    Parameters
    ----------
    context
        The controller's name, which is the prefix of its parameters, and the control period.

    Raises
    ------
    ConfigurationError
        All velocity limits are 0, so that the robot cannot move.

    """

    accelerates = False

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        self._sim_period_s = float(
            context.value(
                'sim_period',
                context.period_s,
                'The time in s within which a velocity has to be reached.',
            )
        )

    def window_s(self) -> float:
        """Return the control period in s."""
        return self._sim_period_s


def make_generator(name: str, context: PluginContext) -> StandardTrajectoryGenerator:
    """
    Make a trajectory generator by its name.

    Parameters
    ----------
    name
        Such as `dwb_plugins::LimitedAccelGenerator`; the prefix may be left out.
    context
        The controller's name, which is the prefix of its parameters, and the control period.

    Raises
    ------
    ConfigurationError
        There is no such generator, or its parameters do not let the robot move.

    """
    kinds = {
        'StandardTrajectoryGenerator': StandardTrajectoryGenerator,
        'LimitedAccelGenerator': LimitedAccelGenerator,
    }
    plain = name.replace('/', '::').removeprefix('dwb_plugins::')
    if plain not in kinds:
        raise ConfigurationError(
            f"There is no trajectory generator '{name}'. These exist: "
            'dwb_plugins::StandardTrajectoryGenerator, dwb_plugins::LimitedAccelGenerator.'
        )
    return kinds[plain](context)


def _samples(now: float, low: float, high: float, up: float, down: float, count: int) -> Floats:
    """Sample reachable velocities, always including 0 if it is reachable."""
    if low > high:
        low, high = high, low
    first = min(max(now - down, low), high)
    last = min(max(now + up, low), high)
    if last - first < 1e-6 or count < 2:
        near = 0.0 if first <= 0.0 <= last else min(max(now, first), last)
        return np.array([near], np.float32)
    found = np.linspace(first, last, count, dtype=np.float32)
    if first < 0.0 < last:
        found[int(np.argmin(np.abs(found[1:-1]))) + 1 if count > 2 else 0] = 0.0
    return found


def _approach(now: float, target: Floats, up: Floats, down: Floats) -> Floats:
    """Compute the (S, T) velocities while accelerating from one velocity to (S,) others."""
    return np.clip(target[:, None], np.float32(now) - down, np.float32(now) + up)
