# SPDX-License-Identifier: Apache-2.0
"""MPPI optimizer: improves a control sequence by random samples."""

from __future__ import annotations

import math

from nav2_controller.control import ControlState, NoValidControl, Velocity
from nav2_mppi_controller.critics import Critic
from nav2_mppi_controller.motion import (
    limit_controls,
    Noise,
    roll_out,
    smoothed,
    Trajectories,
    weighted_mean,
)
from nav2_mppi_controller.parameters import MppiParameters
from nav2_mppi_controller.scene import Scene
import numpy as np
import numpy.typing as npt

__all__ = ['Optimizer']

Floats = npt.NDArray[np.float32]


class Optimizer:
    """
    Optimizer that improves a control sequence in each period.

    Source: G. Williams et al., Information-Theoretic Model Predictive Control, IEEE Transactions
    on Robotics 34 (2018).

    Parameters
    ----------
    critics
        The critics that score trajectories.
    rng
        The random number generator.

    """

    def __init__(self, critics: list[Critic], rng: np.random.Generator) -> None:
        self._critics = critics
        self._noise = Noise(rng)
        self._best: Floats = np.zeros((3, 0), np.float32)
        self._history: Floats = np.zeros((3, 4), np.float32)
        self.trajectories: Trajectories | None = None
        """The candidate trajectories of the last iteration."""

    def reset(self) -> None:
        """Reset the control sequence."""
        self._best = np.zeros((3, 0), np.float32)
        self._history[:] = 0.0

    @property
    def best(self) -> Floats:
        """(3, T) the current control sequence."""
        return self._best

    def optimize(self, state: ControlState, settings: MppiParameters, ratio: float) -> Velocity:
        """
        Compute the velocity for the next period.

        Parameters
        ----------
        state
            The robot, its path and the costmap in this control period.
        settings
            The settings of limits and sampling.
        ratio
            The allowed fraction of the speed limits, from 0 to 1.

        Raises
        ------
        NoValidControl
            All trajectories collide.

        """
        if self._best.shape[1] != settings.time_steps:
            self._best = np.zeros((3, settings.time_steps), np.float32)
        for attempt in range(settings.retry_attempt_limit + 1):
            if self._improve(state, settings, ratio):
                break
            self.reset()
            self._best = np.zeros((3, settings.time_steps), np.float32)
            if attempt == settings.retry_attempt_limit:
                raise NoValidControl(
                    f'All {settings.batch_size} trajectories hit an obstacle. Plan another path.'
                )
        self._best = smoothed(self._best, self._history)
        control = limit_controls(self._best, state.velocity, settings, ratio)[:, 0]
        self._history = np.concatenate([self._history[:, 1:], control[:, None]], axis=1)
        self._shift(state.period_s / settings.model_dt)
        return Velocity(*(float(each) for each in control))

    def _improve(self, state: ControlState, p: MppiParameters, ratio: float) -> bool:
        """Run one iteration; return whether any trajectory is collision-free."""
        for _ in range(p.iteration_count):
            noise = self._noise.sample(p)
            sampled = self._best[:, None] + noise
            controls = limit_controls(sampled, state.velocity, p, ratio)
            self.trajectories = roll_out(state.pose, state.velocity, controls, p)
            scene = Scene(state, self.trajectories, p)
            total = np.zeros(p.batch_size, np.float32)
            for critic in self._critics:
                costs = critic.costs(scene)
                if costs is not None:
                    total += costs
            if scene.collides.all():
                return False
            # The mean of limited samples would never reach the limits.
            self._best = weighted_mean(sampled, total, self._best, p)
            self._best = limit_controls(self._best, state.velocity, p, ratio)
        return True

    def _shift(self, steps: float) -> None:
        """Shift the control sequence to the start of the next period."""
        count = self._best.shape[1]
        at = np.minimum(np.arange(count) + min(steps, count), count - 1)
        low = np.floor(at).astype(int)
        part = (at - low).astype(np.float32)
        high = np.minimum(low + math.ceil(steps > 0), count - 1)
        self._best = self._best[:, low] * (1 - part) + self._best[:, high] * part
