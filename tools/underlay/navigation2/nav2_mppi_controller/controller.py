# SPDX-License-Identifier: Apache-2.0
"""The MPPI controller plugin: its critics, path handling and displays."""

from __future__ import annotations

from dataclasses import replace
import math

from nav2_controller.control import Command, Controller, ControlState, Displays, Velocity
from nav2_controller.plugins import PluginContext
from nav2_controller.tracking import path_lengths
from nav2_mppi_controller import critics, obstacle_critics
from nav2_mppi_controller.critics import Critic
from nav2_mppi_controller.motion import roll_out
from nav2_mppi_controller.optimizer import Optimizer
from nav2_mppi_controller.parameters import MppiParameters, UNSUPPORTED
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import angle_between
from nav2_util.plugins import did_you_mean
import numpy as np
import numpy.typing as npt

__all__ = ['MPPIController']

FloatArray = npt.NDArray[np.float64]

_CRITICS: dict[str, type[Critic]] = {
    'ConstraintCritic': critics.ConstraintCritic,
    'CostCritic': obstacle_critics.CostCritic,
    'GoalAngleCritic': critics.GoalAngleCritic,
    'GoalCritic': critics.GoalCritic,
    'ObstaclesCritic': obstacle_critics.ObstaclesCritic,
    'PathAlignCritic': critics.PathAlignCritic,
    'PathAlignLegacyCritic': critics.PathAlignCritic,
    'PathAngleCritic': critics.PathAngleCritic,
    'PathFollowCritic': critics.PathFollowCritic,
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
