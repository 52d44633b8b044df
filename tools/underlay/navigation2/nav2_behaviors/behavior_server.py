# SPDX-License-Identifier: Apache-2.0
"""The node that offers the behaviours as actions, and their official types."""

from __future__ import annotations

from typing import Any

from nav2_behaviors.assisted_teleop import AssistedTeleop
from nav2_behaviors.behavior_node import BehaviorNode, BehaviorServerParameters, DEFAULT_TYPES
from nav2_behaviors.recoveries import BackUp, DriveOnHeading, Spin, Wait
from nav2_behaviors.timed_behavior import TimedBehavior
from nav2_util import ConfigurationError
from nav2_util.plugins import did_you_mean, plugin_type
from nav2_util.twist import Velocity

__all__ = ['BehaviorServer', 'behavior_types']

behavior_types: dict[str, type[TimedBehavior]] = {
    'nav2_behaviors::Spin': Spin,
    'nav2_behaviors::BackUp': BackUp,
    'nav2_behaviors::DriveOnHeading': DriveOnHeading,
    'nav2_behaviors::AssistedTeleop': AssistedTeleop,
    'nav2_behaviors::Wait': Wait,
}
"""Registry of behaviour types; add a class here to offer a custom behaviour."""


class BehaviorServer(BehaviorNode):
    """
    Behaviour server; by default spin, backup, drive_on_heading, assisted_teleop and wait.

    Parameters
    ----------
    node_name, options
        As for `LifecycleNode`.

    """

    def __init__(self, node_name: str = 'behavior_server', **options: Any) -> None:
        super().__init__(node_name, **options)
        self.behaviors: dict[str, TimedBehavior] = {}

    def configure(self) -> None:
        """Read the parameters; create the behaviours and their shared resources."""
        names = self.parameters.declare(BehaviorServerParameters).current.behavior_plugins
        if not names or len(set(names)) < len(names):
            raise ConfigurationError(
                "The parameter 'behavior_plugins' must name at least one behaviour, each only "
                f'once; it is {names}.'
            )
        super().configure()
        for name in names:
            default = DEFAULT_TYPES.get(name, '')
            kind = plugin_type(self.parameters, name, 'behaviour', default, behavior_types)
            self.behaviors[name] = _behavior_type(name, kind)(self, name)

    def deactivate(self) -> None:
        """Stop the robot if a behaviour is moving it."""
        if any(behavior.server.is_running for behavior in self.behaviors.values()):
            self.velocities.publish(Velocity())

    def cleanup(self) -> None:
        """Release the behaviours."""
        self.behaviors = {}
        super().cleanup()


def _behavior_type(behavior: str, name: str) -> type[TimedBehavior]:
    """
    Look up the class of a behaviour.

    Parameters
    ----------
    behavior
        The name of the behaviour.
    name
        Its type, as `nav2_behaviors::Spin` or `nav2_behaviors/Spin`.

    Raises
    ------
    ConfigurationError
        There is no such type.

    """
    official = name.replace('/', '::')
    if official in behavior_types:
        return behavior_types[official]
    advice = did_you_mean(official, behavior_types, 0.6)
    raise ConfigurationError(
        f"The parameter '{behavior}.plugin' is '{name}', which is not one of the types "
        f'{", ".join(behavior_types)}.{advice}'
    )
