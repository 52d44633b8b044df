# SPDX-License-Identifier: Apache-2.0
"""The MPPI controller plugin: optimizes controls by random samples along the path."""

from __future__ import annotations

from dataclasses import replace
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
from nav2_controller.tracking import path_lengths
from nav2_mppi_controller import critics, obstacle_critics, path_critics
from nav2_mppi_controller.critics import Critic
from nav2_mppi_controller.motion import (
    limit_controls,
    Noise,
    roll_out,
    smoothed,
    Trajectories,
    weighted_mean,
)
from nav2_mppi_controller.parameters import MppiParameters, UNSUPPORTED
from nav2_mppi_controller.scene import Scene
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import angle_between
from nav2_util.plugins import did_you_mean
import numpy as np
import numpy.typing as npt

__all__ = ['MPPIController', 'Optimizer']

Floats = npt.NDArray[np.float32]

_CRITICS: dict[str, type[Critic]] = {
    'ConstraintCritic': critics.ConstraintCritic,
    'CostCritic': obstacle_critics.CostCritic,
    'GoalAngleCritic': critics.GoalAngleCritic,
    'GoalCritic': critics.GoalCritic,
    'ObstaclesCritic': obstacle_critics.ObstaclesCritic,
    'PathAlignCritic': path_critics.PathAlignCritic,
    'PathAlignLegacyCritic': path_critics.PathAlignCritic,
    'PathAngleCritic': path_critics.PathAngleCritic,
    'PathFollowCritic': path_critics.PathFollowCritic,
    'PreferForwardCritic': critics.PreferForwardCritic,
    'TwirlingCritic': critics.TwirlingCritic,
    'VelocityDeadbandCritic': critics.VelocityDeadbandCritic,
}
_USUAL = [
    'ConstraintCritic',
    'CostCritic',
    'GoalCritic',
    'GoalAngleCritic',
    'PathAlignCritic',
    'PathFollowCritic',
    'PathAngleCritic',
    'PreferForwardCritic',
]


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


class MPPIController(Controller):
    """
    Controller that computes controls as a weighted mean of random samples, scored by critics.

    Parameters
    ----------
    context
        Its name and parameters.
    seed
        The seed of the random numbers.

    """

    def __init__(self, context: PluginContext, seed: int = 0) -> None:
        self._parameters = context.declare(MppiParameters)
        context.unsupported(UNSUPPORTED)
        self.search_distance_m = context.search_distance()
        self.transform_tolerance_s = context.transform_tolerance()
        names = context.value('critics', _USUAL, 'The critics, by their names.')
        made = [_find(name)(context.named(f'{context.name}.{name}')) for name in names]
        # Critics that detect collisions come first: others can skip colliding trajectories.
        self._optimizer = Optimizer(made, np.random.default_rng(seed))
        self._last_s: float | None = None

    def new_plan(self, *, is_new_goal: bool) -> None:
        """
        Set a new path.

        Parameters
        ----------
        is_new_goal
            Whether the path leads to another goal, so that the optimizer is reset; otherwise it
            is a new path to the same goal.

        """
        if is_new_goal:
            self._optimizer.reset()

    def compute(self, state: ControlState) -> Command:
        """
        Compute the velocity command by model predictive path integral (MPPI) control.

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
            All trajectories collide.

        """
        p = self._parameters.current
        if self._last_s is not None and state.now_s - self._last_s > p.reset_period:
            self._optimizer.reset()
        self._last_s = state.now_s
        state = _pruned(state, p)
        ratio = self.limit_ratio(p.vx_max)
        velocity = self._optimizer.optimize(state, p, ratio)
        if ratio < 1.0 and velocity.linear > ratio * p.vx_max:
            # Lateral motion adds to the limited speed.
            factor = ratio * p.vx_max / velocity.linear
            velocity = Velocity(velocity.x * factor, velocity.y * factor, velocity.yaw)
        best = self._optimizer.best[:, None, :]
        path = roll_out(state.pose, velocity, best, p)
        shown = Displays(
            local_plan=np.stack([path.x[0], path.y[0], path.yaw[0]], axis=1, dtype=np.float64)
        )
        tried = self._optimizer.trajectories
        if p.visualize and tried is not None:
            step, part = max(p.trajectory_step, p.batch_size // 200), p.trajectory_time_step
            shown.trajectories = np.stack(
                [tried.x[::step, ::part], tried.y[::step, ::part]], axis=2, dtype=np.float64
            )
        return Command(velocity, shown)


def _find(name: str) -> type[Critic]:
    plain = name.replace('/', '::').rpartition('::')[2]
    if plain not in _CRITICS:
        raise ConfigurationError(
            f"MPPI has no critic '{name}'.{did_you_mean(plain, _CRITICS)} "
            f'These exist: {", ".join(_CRITICS)}.'
        )
    return _CRITICS[plain]


def _pruned(state: ControlState, p: MppiParameters) -> ControlState:
    """Prune the path of the state to the part that is considered."""
    plan, whole = state.plan, state.is_goal_in_plan
    lengths = path_lengths(plan)
    # At least the distance covered at full speed.
    limit = max(p.prune_distance, 1.2 * p.vx_max * p.model_dt * p.time_steps)
    end = int(np.searchsorted(lengths, limit, 'right'))
    if p.enforce_path_inversion:
        end = min(end, _inversion(state, p))
    if end >= len(plan):
        return state
    return replace(state, plan=plan[: max(end, 1)], is_goal_in_plan=whole and end >= len(plan))


def _inversion(state: ControlState, p: MppiParameters) -> int:
    """Count the poses up to the next path inversion that the robot has not reached yet."""
    steps = np.diff(state.plan[:, :2], axis=0)
    turns = np.flatnonzero((steps[:-1] * steps[1:]).sum(axis=1) < 0.0) + 1
    for index in turns:
        x, y, yaw = state.plan[index]
        far = math.hypot(x - state.pose.x, y - state.pose.y) > p.inversion_xy_tolerance
        turned = abs(angle_between(state.pose.yaw, yaw)) > p.inversion_yaw_tolerance
        if far or turned:
            return int(index) + 1
    return len(state.plan)
