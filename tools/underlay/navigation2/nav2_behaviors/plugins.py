# SPDX-License-Identifier: Apache-2.0
"""The behaviour plugins by their official types."""

from __future__ import annotations

from nav2_behaviors.assisted_teleop import AssistedTeleop
from nav2_behaviors.drive_on_heading import BackUp, DriveOnHeading
from nav2_behaviors.spin import Spin
from nav2_behaviors.timed_behavior import TimedBehavior
from nav2_behaviors.wait import Wait
from nav2_util import ConfigurationError
from nav2_util.plugins import did_you_mean

__all__ = ['DEFAULT_TYPES', 'behavior_type', 'behavior_types']

behavior_types: dict[str, type[TimedBehavior]] = {
    'nav2_behaviors::Spin': Spin,
    'nav2_behaviors::BackUp': BackUp,
    'nav2_behaviors::DriveOnHeading': DriveOnHeading,
    'nav2_behaviors::AssistedTeleop': AssistedTeleop,
    'nav2_behaviors::Wait': Wait,
}
"""Registry of behaviour types; add a class here to offer a custom behaviour."""

DEFAULT_TYPES = {
    'spin': 'nav2_behaviors::Spin',
    'backup': 'nav2_behaviors::BackUp',
    'drive_on_heading': 'nav2_behaviors::DriveOnHeading',
    'assisted_teleop': 'nav2_behaviors::AssistedTeleop',
    'wait': 'nav2_behaviors::Wait',
}
"""The types of the default behaviours."""


def behavior_type(behavior: str, name: str) -> type[TimedBehavior]:
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
    if not name:
        raise ConfigurationError(
            f"The behaviour '{behavior}' has no type: set the parameter '{behavior}.plugin', as "
            "'nav2_behaviors::Spin'."
        )
    advice = did_you_mean(official, behavior_types, 0.6)
    raise ConfigurationError(
        f"The parameter '{behavior}.plugin' is '{name}', which is none of the types "
        f'{", ".join(behavior_types)}.{advice}'
    )
