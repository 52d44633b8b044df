# SPDX-License-Identifier: Apache-2.0
"""The critics of DWB by their official names."""

from __future__ import annotations

from dwb_critics.critic import Critic
from dwb_critics.map_grid import (
    GoalAlignCritic,
    GoalDistCritic,
    PathAlignCritic,
    PathDistCritic,
)
from dwb_critics.motion import (
    OscillationCritic,
    PreferForwardCritic,
    RotateToGoalCritic,
    TwirlingCritic,
)
from dwb_critics.obstacles import BaseObstacleCritic, ObstacleFootprintCritic
from nav2_util.errors import ConfigurationError
from nav2_util.plugins import did_you_mean

__all__ = ['find_critic']

_KINDS: dict[str, type[Critic]] = {
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


def find_critic(name: str) -> type[Critic]:
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
    if plain not in _KINDS:
        raise ConfigurationError(
            f"There is no critic '{name}' of DWB.{did_you_mean(plain, _KINDS)} "
            f'These exist: {", ".join(_KINDS)}.'
        )
    return _KINDS[plain]
