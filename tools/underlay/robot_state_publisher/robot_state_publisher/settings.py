# SPDX-License-Identifier: Apache-2.0
"""Validation of the parameters of robot_state_publisher."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from urdf import parse_urdf, RobotModel

__all__ = ['DESCRIPTIONS', 'Settings']

DESCRIPTIONS = {
    'robot_description': 'The text of the URDF.',
    'publish_frequency': 'The maximum publishing rate of a joint, in Hz: above 0, up to 1000.',
    'ignore_timestamp': 'Publish every joint state, whatever its stamp and the frequency.',
    'frame_prefix': "The prefix of all frame names, such as 'robot1/'.",
}


@dataclass(frozen=True)
class Settings:
    """Settings of the node."""

    robot_description: str = ''
    publish_frequency: float = 20.0
    ignore_timestamp: bool = False
    frame_prefix: str = ''

    def changed(self, values: Mapping[str, Any]) -> Settings:
        """
        Return a copy with new values.

        Parameters
        ----------
        values
            Parameter values by name; unknown names are ignored.

        """
        known = {field.name for field in fields(self)}
        return replace(self, **{name: values[name] for name in known & values.keys()})

    def model(self, source: str = 'robot_description') -> RobotModel:
        """
        Validate the settings and parse the robot description.

        Parameters
        ----------
        source
            The origin of the description, for error messages: a file or the name of a parameter.

        Raises
        ------
        ValueError
            The frequency or the description is invalid.

        """
        frequency: Any = self.publish_frequency
        is_number = isinstance(frequency, (int, float)) and not isinstance(frequency, bool)
        if not is_number or not 0.0 < frequency <= 1000.0:
            raise ValueError(
                'publish_frequency must be a number, more than 0 and at most 1000, '
                f'and not {frequency!r}.'
            )
        return parse_urdf(self.robot_description, source)
