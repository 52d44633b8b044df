# SPDX-License-Identifier: Apache-2.0
"""Sampled controls, their simulated trajectories, and their weighted mean."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_controller.control import Velocity
from nav2_mppi_controller.parameters import MppiParameters
from nav2_util.geometry import Pose2D
import numpy as np
import numpy.typing as npt

__all__ = ['Noise', 'Trajectories', 'limit_controls', 'roll_out', 'smoothed', 'weighted_mean']

Floats = npt.NDArray[np.float32]

# Savitzky-Golay filter: a parabola fitted to 9 points, evaluated at the middle one.
_FILTER = np.array([-21, 14, 39, 54, 59, 54, 39, 14, -21], np.float32) / np.float32(231)


@dataclass(frozen=True)
class Trajectories:
    """K trajectories of T steps; positions in m in the frame of the costmap, yaw not wrapped."""

    controls: Floats
    """(3, K, T): vx, vy in m/s, wz in rad/s, as commanded."""
    velocities: Floats
    """(3, K, T): the velocities of the robot in each step."""
    x: Floats
    """(K, T)"""
    y: Floats
    yaw: Floats


class Noise:
    """
    Noise of the controls: drawn once; `regenerate_noises` uses other parts of it each time.

    Parameters
    ----------
    rng
        The random number generator.

    """

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self._pool: Floats = np.zeros((3, 0), np.float32)
        self._starts = [0, 0, 0]

    def sample(self, settings: MppiParameters) -> Floats:
        """
        Sample Gaussian noise for the controls.

        Parameters
        ----------
        settings
            The batch size, the time steps, the standard deviations and `regenerate_noises`.

        Returns
        -------
        Floats
            (3, K, T) noise of vx, vy in m/s, wz in rad/s; vy is 0 unless the motion model is Omni.
            It is the same each time unless `regenerate_noises` is true.

        """
        p = settings
        stds = (p.vx_std, p.vy_std if p.motion_model == 'Omni' else 0.0, p.wz_std)
        count = p.batch_size * p.time_steps
        spare = max(count // 2, 1)
        if self._pool.shape[1] != count + spare:
            self._pool = self._rng.standard_normal((3, count + spare), dtype=np.float32)
        if p.regenerate_noises:
            self._starts = [int(each) for each in self._rng.integers(0, spare, 3)]
        noise = np.zeros((3, p.batch_size, p.time_steps), np.float32)
        for row, drawn, start, std in zip(noise, self._pool, self._starts, stds):
            if std:
                part = drawn[slice(start, start + count)].reshape(row.shape)
                np.multiply(part, np.float32(std), out=row)
        return noise


def limit_controls(
    controls: Floats, start: Velocity, settings: MppiParameters, ratio: float = 1.0
) -> Floats:
    """
    Limit controls to the velocity and acceleration limits of the robot.

    Parameters
    ----------
    controls
        (3, ..., T) vx, vy in m/s, wz in rad/s.
    start
        The velocity before the first step.
    settings
        The limits.
    ratio
        The allowed fraction of the velocity limits, from 0 to 1.

    """
    p, dt = settings, settings.model_dt
    highs = np.array([p.vx_max, p.vy_max, p.wz_max], np.float32) * np.float32(ratio)
    lows = np.array([p.vx_min, -p.vy_max, -p.wz_max], np.float32) * np.float32(ratio)
    ups = np.array([p.ax_max, p.ay_max, p.az_max], np.float32) * np.float32(dt)
    downs = np.array([-p.ax_min, -p.ay_min, p.az_max], np.float32) * np.float32(dt)
    limited = np.empty_like(controls)
    for k in range(3):
        if k == 1 and p.motion_model != 'Omni':
            limited[k] = 0.0
            continue
        steps = np.arange(1, controls.shape[-1] + 1, dtype=np.float32)
        # Velocities reachable from the start by then; a cheap bound of the step limits.
        low = np.maximum(lows[k], np.minimum(start[k], highs[k]) - downs[k] * steps)
        high = np.minimum(highs[k], np.maximum(start[k], lows[k]) + ups[k] * steps)
        np.clip(controls[k], np.minimum(low, high), high, out=limited[k])
    if p.motion_model == 'Ackermann':
        most = np.abs(limited[0]) / np.float32(max(p.min_turning_r, 1e-3))
        np.clip(limited[2], -most, most, out=limited[2])
    return limited


def roll_out(
    pose: Pose2D, start: Velocity, controls: Floats, settings: MppiParameters
) -> Trajectories:
    """
    Simulate the trajectories of controls.

    Parameters
    ----------
    pose, start
        The robot in the frame of the costmap, and its velocity.
    controls
        (3, K, T) controls.
    settings
        The duration of a step, and the motion model.

    """
    dt = np.float32(settings.model_dt)
    velocities = np.empty_like(controls)
    # A command takes effect one step later.
    velocities[:, :, 1:] = controls[:, :, :-1]
    velocities[:, :, 0] = np.array(start, np.float32)[:, None]
    yaw = np.cumsum(velocities[2], axis=1)
    yaw *= dt
    yaw += np.float32(pose.yaw)
    before = yaw - velocities[2] * dt
    cos, sin = np.cos(before), np.sin(before)
    if settings.motion_model == 'Omni':
        step_x = velocities[0] * cos - velocities[1] * sin
        step_y = velocities[0] * sin + velocities[1] * cos
    else:
        step_x, step_y = velocities[0] * cos, velocities[0] * sin
    x, y = np.cumsum(step_x, axis=1), np.cumsum(step_y, axis=1)
    x *= dt
    y *= dt
    x += np.float32(pose.x)
    y += np.float32(pose.y)
    return Trajectories(controls, velocities, x, y, yaw)


def weighted_mean(
    controls: Floats, costs: Floats, best: Floats, settings: MppiParameters
) -> Floats:
    """
    Compute the mean of controls, weighted by their costs.

    Parameters
    ----------
    controls
        (3, K, T) controls.
    costs
        (K,) costs of the trajectories.
    best
        (3, T) the control to which the noise was added.
    settings
        The temperature, gamma and the standard deviations.

    Source
    ------
    G. Williams et al., Information-Theoretic Model Predictive Control, T-RO 34 (2018).

    """
    p = settings
    total = costs.astype(np.float32)
    for k, std in enumerate((p.vx_std, p.vy_std, p.wz_std)):
        if std and p.gamma and (k != 1 or p.motion_model == 'Omni'):
            total = total + np.float32(p.gamma / std**2) * ((controls[k] - best[k]) @ best[k])
    weights = np.exp((total.min() - total) * np.float32(1.0 / p.temperature))
    weights /= weights.sum()
    return np.stack([weights @ each for each in controls])


def smoothed(best: Floats, history: Floats) -> Floats:
    """
    Smooth a sequence of controls by a Savitzky-Golay filter of order 2 over 9 points.

    Parameters
    ----------
    best
        (3, T) controls vx, vy in m/s, wz in rad/s; fewer than 9 are unchanged.
    history
        (3, 4) previous commands, the oldest first.

    Returns
    -------
    Floats
        (3, T) controls.

    """
    if best.shape[1] < 9:
        return best
    ends = np.repeat(best[:, -1:], 4, axis=1)
    padded = np.concatenate([history, best, ends], axis=1)
    return np.stack([np.convolve(row, _FILTER, 'valid') for row in padded])
