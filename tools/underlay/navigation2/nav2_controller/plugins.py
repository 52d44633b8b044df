# SPDX-License-Identifier: Apache-2.0
"""Registry of the plugins by their official names, and the context that they are made with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
import math
from typing import Any, Protocol, TypeVar

from nav2_util.parameters import ParameterSet, Unsupported

__all__ = [
    'CONTROLLERS',
    'GOAL_CHECKERS',
    'PROGRESS_CHECKERS',
    'ParameterSource',
    'PluginContext',
]

KindT = TypeVar('KindT')

CONTROLLERS = {
    'dwb_core::DWBLocalPlanner': 'dwb_core.local_planner:DWBLocalPlanner',
    'nav2_graceful_controller::GracefulController': (
        'nav2_graceful_controller.graceful_controller:GracefulController'
    ),
    'nav2_mppi_controller::MPPIController': 'nav2_mppi_controller.controller:MPPIController',
    'nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController': (
        'nav2_regulated_pure_pursuit_controller.controller:RegulatedPurePursuitController'
    ),
    'nav2_rotation_shim_controller::RotationShimController': (
        'nav2_rotation_shim_controller.controller:RotationShimController'
    ),
}
PROGRESS_CHECKERS = {
    'nav2_controller::SimpleProgressChecker': 'nav2_controller.checkers:SimpleProgressChecker',
    'nav2_controller::PoseProgressChecker': 'nav2_controller.checkers:PoseProgressChecker',
}
GOAL_CHECKERS = {
    'nav2_controller::SimpleGoalChecker': 'nav2_controller.checkers:SimpleGoalChecker',
    'nav2_controller::StoppedGoalChecker': 'nav2_controller.checkers:StoppedGoalChecker',
    'nav2_controller::PositionGoalChecker': 'nav2_controller.checkers:PositionGoalChecker',
}


class ParameterSource(Protocol):
    """Interface that declares parameters; `nav2_util.parameters.ParameterServer` implements it."""

    def declare(self, kind: type[KindT], prefix: str = '') -> ParameterSet[KindT]:
        """
        Declare all parameters of a dataclass.

        Parameters
        ----------
        kind
            A frozen dataclass with fields made by `nav2_util.parameters.parameter`.
        prefix
            The prefix of their names, without the dot.

        Returns
        -------
        ParameterSet
            Their values, updated by later changes.

        """

    def declare_value(self, name: str, default: Any, description: str) -> Any:
        """
        Declare a single parameter; return its value.

        Parameters
        ----------
        name
            Its full name.
        default
            Its value if it is not set, which also gives its type.
        description
            Its purpose, with the unit.

        """

    def declare_unsupported(
        self, names: Mapping[str, str | Unsupported], prefix: str = ''
    ) -> None:
        """
        Declare unsupported parameters, to warn if they are set.

        Parameters
        ----------
        names
            Their names, and what happens instead, as the end of a sentence, or with the values
            that need no warning.
        prefix
            The prefix of their names, without the dot.

        """


@dataclass(frozen=True)
class PluginContext:
    """Context of a plugin: its name, its parameters, and properties of its server."""

    source: ParameterSource
    name: str
    """The prefix of its parameters, such as FollowPath."""
    period_s: float = 0.05
    """The control period."""
    costmap_extent_m: float = 1.5
    """Half of the longer side of the local costmap."""

    def declare(self, kind: type[KindT], below: str = '') -> ParameterSet[KindT]:
        """
        Declare the parameters of a dataclass, with the name of the plugin as prefix.

        Parameters
        ----------
        kind
            A frozen dataclass with fields made by `nav2_util.parameters.parameter`.
        below
            A second prefix, after the name of the plugin.

        Returns
        -------
        ParameterSet
            Their values, updated by later changes.

        """
        return self.source.declare(kind, self._prefix(below))

    def value(self, name: str, default: Any, description: str) -> Any:
        """
        Declare a single parameter, with the name of the plugin as prefix; return its value.

        Parameters
        ----------
        name
            Its name without the prefix.
        default
            Its value if it is not set, which also gives its type.
        description
            Its purpose, with the unit.

        """
        return self.source.declare_value(f'{self.name}.{name}', default, description)

    def unsupported(self, names: Mapping[str, str | Unsupported], below: str = '') -> None:
        """
        Declare unsupported parameters of the plugin, to warn if they are set.

        Parameters
        ----------
        names
            Their names, and what happens instead, as the end of a sentence, or with the values
            that need no warning.
        below
            A second prefix, after the name of the plugin.

        """
        self.source.declare_unsupported(names, self._prefix(below))

    def search_distance(self) -> float:
        """Declare `max_robot_pose_search_dist`; return it in m, infinite for -1."""
        found = float(
            self.value(
                'max_robot_pose_search_dist',
                self.costmap_extent_m,
                'How far in m along the path the nearest pose is searched; -1: everywhere.',
            )
        )
        return math.inf if found < 0.0 else found

    def transform_tolerance(self, default_s: float = 0.1) -> float:
        """
        Declare `transform_tolerance`; return it in s.

        Parameters
        ----------
        default_s
            Its value if it is not set.

        """
        return float(
            self.value(
                'transform_tolerance',
                default_s,
                "How old in s the robot's pose may be; never less than 0.5 s.",
            )
        )

    def named(self, name: str) -> PluginContext:
        """
        Copy the context for a plugin of another name.

        Parameters
        ----------
        name
            The prefix of its parameters.

        """
        return replace(self, name=name)

    def _prefix(self, below: str) -> str:
        return f'{self.name}.{below}' if below else self.name
