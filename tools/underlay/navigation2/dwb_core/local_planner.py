# SPDX-License-Identifier: Apache-2.0
"""DWB: sample many velocities at once, and choose the one that its critics score best."""

from __future__ import annotations

from dataclasses import dataclass, replace
import math

from dwb_critics.critic import Critic, Scene
from dwb_critics.grid import (
    BaseObstacleCritic,
    GoalAlignCritic,
    GoalDistCritic,
    ObstacleFootprintCritic,
    PathAlignCritic,
    PathDistCritic,
)
from dwb_critics.motion import (
    OscillationCritic,
    PreferForwardCritic,
    RotateToGoalCritic,
    TwirlingCritic,
)
from dwb_plugins.generators import make_generator, Rollouts
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
from nav2_util.errors import ConfigurationError
from nav2_util.parameters import parameter, Unsupported
from nav2_util.plugins import did_you_mean
import numpy as np

__all__ = ['DWBLocalPlanner']

_CRITICS: dict[str, type[Critic]] = {
    'BaseObstacle': BaseObstacleCritic,
    'GoalAlign': GoalAlignCritic,
    'GoalDist': GoalDistCritic,
    'ObstacleFootprint': ObstacleFootprintCritic,
    'Oscillation': OscillationCritic,
    'PathAlign': PathAlignCritic,
    'PathDist': PathDistCritic,
    'PreferForward': PreferForwardCritic,
    'RotateToGoal': RotateToGoalCritic,
    'Twirling': TwirlingCritic,
}
"""The critics by their official names."""
_UNSUPPORTED: dict[str, str | Unsupported] = {
    'goal_checker_name': 'the goal checkers of the controller server are used',
    'publish_evaluation': Unsupported('scores are not published', (True, False)),
    'publish_cost_grid_pc': Unsupported('the grids of critics are not published', (False,)),
    'publish_input_params': Unsupported('they are not published', (True, False)),
    'publish_trajectories': Unsupported(
        "trajectories are published on 'marker' when somebody listens", (True,)
    ),
    'publish_global_plan': Unsupported(
        "'received_global_plan' is published when somebody listens", (True,)
    ),
    'publish_transformed_plan': Unsupported(
        "'transformed_global_plan' is published when somebody listens", (True,)
    ),
    'publish_local_plan': Unsupported("'local_plan' is published when somebody listens", (True,)),
    'marker_lifetime': Unsupported('trajectories are shown until the next ones', (0.1,)),
    'prune_plan': Unsupported('what was passed of the path is always left out', (True,)),
    'stateful': Unsupported('the goal checker has this parameter'),
    'xy_goal_tolerance': Unsupported('the critic RotateToGoal, which uses it, is not in critics'),
    'trans_stopped_velocity': Unsupported(
        'the critic RotateToGoal, which uses it, is not in critics'
    ),
    'limit_vel_cmd_in_traj': Unsupported('trajectories start at the measured velocity', (False,)),
    'path_distance_bias': 'set PathAlign.scale and PathDist.scale',
    'goal_distance_bias': 'set GoalAlign.scale and GoalDist.scale',
    'occdist_scale': 'set BaseObstacle.scale or ObstacleFootprint.scale',
    'max_scaling_factor': 'the footprint keeps its size at any speed',
    'scaling_speed': 'the footprint keeps its size at any speed',
    'prune_distance': Unsupported(
        'the path is followed from the pose nearest to the robot', (1.0, 2.0)
    ),
}


@dataclass(frozen=True)
class DwbParameters:
    """The parameters of DWB, besides those of its generator and critics."""

    default_critic_namespaces: list[str] = parameter(
        ['dwb_critics'], 'What may be left out before the names of critics.'
    )
    shorten_transformed_plan: bool = parameter(
        True, 'Whether critics only see the path up to forward_prune_distance.'
    )
    forward_prune_distance: float = parameter(
        2.0, 'The length in m of the path that is regarded; -1: as far as the costmap.'
    )
    debug_trajectory_details: bool = parameter(
        False, 'Whether to log what critics object to when no velocity is left.'
    )
    trajectory_generator_name: str = parameter(
        'dwb_plugins::StandardTrajectoryGenerator', 'The generator of trajectories.'
    )
    short_circuit_trajectory_evaluation: bool = parameter(
        True, 'Accepted; all trajectories are scored at once.'
    )


class DWBLocalPlanner(Controller):
    """
    Controller that chooses among sampled velocities, also lateral ones, by weighted critic scores.

    Source: D. Fox, W. Burgard, S. Thrun, The Dynamic Window Approach to Collision Avoidance, IEEE
    Robotics and Automation Magazine 4 (1997).

    Parameters
    ----------
    context
        The plugin's name, which is the prefix of its parameters, and the control period.

    Raises
    ------
    ConfigurationError
        `critics` is empty, a critic or the generator is unknown or misconfigured, or no velocity
        limit is above 0.

    """

    def __init__(self, context: PluginContext) -> None:
        self._parameters = context.declare(DwbParameters)
        context.unsupported(_UNSUPPORTED)
        self.transform_tolerance_s = context.transform_tolerance()
        generator = self._parameters.current.trajectory_generator_name
        self._generator = make_generator(generator, context)
        names = context.value('critics', [], 'The critics, by their names.')
        if not names:
            raise ConfigurationError(
                f"The parameter '{context.name}.critics' names no critics. A usual "
                "choice is ['RotateToGoal', 'Oscillation', 'BaseObstacle', 'GoalAlign', "
                "'PathAlign', 'PathDist', 'GoalDist']."
            )
        self._critics = [_make_critic(context, name) for name in names]

    def new_plan(self, *, is_new_goal: bool) -> None:
        """
        Reset the critics if the new path leads to a new goal.

        Parameters
        ----------
        is_new_goal
            Whether the path leads to another goal; otherwise the critics keep their state.

        """
        if is_new_goal:
            for critic in self._critics:
                critic.reset()

    def compute(self, state: ControlState) -> Command:
        """
        Choose the sampled velocity with the lowest total score.

        Parameters
        ----------
        state
            Pose, velocity, path and costmap of this control period.

        Returns
        -------
        Command
            The velocity in the base frame, with its trajectory and some of the others for display.

        Raises
        ------
        NoValidControl
            The critics reject every velocity; the message states the share that each of them
            rejects.

        """
        state = _shortened(state, self._parameters.current)
        ratio = self.limit_ratio(self._generator.fastest)
        velocities = self._generator.velocities(state.velocity, ratio)
        rollouts = self._generator.rollouts(state.pose, state.velocity, velocities)
        scene = Scene(state, rollouts)
        total = np.zeros(len(rollouts), np.float32)
        objections: list[tuple[int, Critic]] = []
        for critic in self._critics:
            critic.begin(scene)
            scale = critic.scale(scene)
            if not scale:
                continue
            scores = critic.scores(scene)
            total += scores * np.float32(scale)
            refused = int(np.isinf(scores).sum())
            if refused:
                objections.append((refused, critic))
        best = int(np.argmin(total))
        if not math.isfinite(float(total[best])):
            raise NoValidControl(_explanation(len(rollouts), objections))
        velocity = Velocity(*(float(each) for each in velocities[best]))
        for critic in self._critics:
            critic.debrief(velocity)
        return Command(velocity, _displays(rollouts, best))


def _make_critic(context: PluginContext, name: str) -> Critic:
    kind = _find_critic(str(context.value(f'{name}.class', name, 'The kind of the critic.')))
    return kind(context.named(f'{context.name}.{name}'))


def _find_critic(name: str) -> type[Critic]:
    """
    Look up the class of a critic.

    Parameters
    ----------
    name
        Such as PathDist, PathDistCritic or dwb_critics::PathDistCritic.

    Raises
    ------
    ConfigurationError
        There is no such critic.

    """
    plain = name.replace('/', '::').removeprefix('dwb_critics::').removesuffix('Critic')
    if plain not in _CRITICS:
        raise ConfigurationError(
            f"DWB has no critic '{name}'.{did_you_mean(plain, _CRITICS)} "
            f'These exist: {", ".join(_CRITICS)}.'
        )
    return _CRITICS[plain]


def _shortened(state: ControlState, parameters: DwbParameters) -> ControlState:
    limit = parameters.forward_prune_distance
    if not parameters.shorten_transformed_plan or limit < 0.0:
        return state
    lengths = path_lengths(state.plan)
    if lengths[-1] <= limit:
        return state
    end = max(int(np.searchsorted(lengths, limit, 'right')), 1)
    return replace(state, plan=state.plan[:end], is_goal_in_plan=False)


def _explanation(count: int, objections: list[tuple[int, Critic]]) -> str:
    objections.sort(key=lambda each: -each[0])
    reasons = ', '.join(
        f'{100.0 * refused / count:.0f} % {critic.objection()} ({critic.name})'
        for refused, critic in objections
    )
    return f'None of {count} velocities is valid: {reasons}. Plan another path.'


def _displays(rollouts: Rollouts, best: int) -> Displays:
    chosen = np.stack(
        [rollouts.x[best], rollouts.y[best], rollouts.yaw[best]], axis=1, dtype=np.float64
    )
    step = max(len(rollouts) // 60, 1)
    shown = np.stack([rollouts.x[::step], rollouts.y[::step]], axis=2, dtype=np.float64)
    return Displays(local_plan=chosen, trajectories=shown)
