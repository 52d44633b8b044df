# SPDX-License-Identifier: Apache-2.0
"""The parameters of the joint controller."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_common.parameters import parameter, ParameterError
from humanoid_control.sine_motion import Motion, motion_of


@dataclass(frozen=True)
class JointControllerParameters:
    """Publishing rate, and the swing of each joint: every list has one element per joint."""

    rate_hz: float = parameter(
        50.0, 'How many joint commands are published a second.', at_least=1.0, at_most=1000.0
    )
    joints: tuple[str, ...] = parameter(
        ('left_shoulder', 'left_elbow', 'right_shoulder', 'right_elbow'),
        'The names of the joints that are moved.',
    )
    amplitudes_rad: tuple[float, ...] = parameter(
        (0.5, 0.8, 0.5, 0.8),
        'How far each joint swings to either side.',
        at_least=-10.0,
        at_most=10.0,
    )
    frequencies_rad_s: tuple[float, ...] = parameter(
        (1.0, 1.5, 1.0, 1.5),
        'How fast the phase of each joint grows.',
        at_least=-1000.0,
        at_most=1000.0,
    )
    phases_rad: tuple[float, ...] = parameter(
        (0.0, 0.0, math.pi, math.pi),
        'The phase of each joint at the start.',
        at_least=-100.0,
        at_most=100.0,
    )
    heartbeat_timeout_s: float = parameter(
        1.0,
        'How long the console that is in control may be silent before the joints are held.',
        at_least=0.2,
        at_most=10.0,
    )

    def __post_init__(self) -> None:
        """Validate the lists against each other."""
        self._check_names()
        for name in ('amplitudes_rad', 'frequencies_rad_s', 'phases_rad'):
            self._check_length(name, len(getattr(self, name)))

    @property
    def motion(self) -> Motion:
        """Return the motion that the parameters describe."""
        return motion_of(self.joints, self.amplitudes_rad, self.frequencies_rad_s, self.phases_rad)

    def _check_names(self) -> None:
        """Check that the joint names are unique and not empty."""
        if '' in self.joints:
            raise ParameterError(
                "Parameter 'joints' contains an empty name. Name every joint.", 'joints'
            )
        twice = sorted({joint for joint in self.joints if self.joints.count(joint) > 1})
        if twice:
            raise ParameterError(
                f"Parameter 'joints' names '{twice[0]}' more than once. Name every joint once.",
                'joints',
            )

    def _check_length(self, name: str, length: int) -> None:
        """Check that a list has one element for each joint."""
        if length != len(self.joints):
            raise ParameterError(
                f"Parameter '{name}' has {length} elements, but 'joints' has "
                f'{len(self.joints)}. Give one element a joint; to change the number of joints '
                'while the node runs, set all four lists in one atomic request.',
                name,
                'joints',
            )
