# SPDX-License-Identifier: Apache-2.0
"""Description of a robot for the simulator: its URDF, and the drives of its joints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from humanoid_description.drives import Drive, load_drives, SIDES
from humanoid_description.expansion import humanoid_urdf


@dataclass(frozen=True)
class RobotDescription:
    """A robot: its URDF, its driven joints, and the prefix of its link and joint names."""

    urdf: str
    drives: Mapping[str, Drive]
    prefix: str = ''

    @property
    def hands(self) -> tuple[str, ...]:
        """Return the sides on which it has hands."""
        return tuple(side for side in SIDES if f'{self.prefix}{side}_gripper' in self.drives)

    @property
    def base(self) -> str:
        """Return the floating base link."""
        return f'{self.prefix}base_link'

    @property
    def imu(self) -> str:
        """Return the link of the inertial measurement unit."""
        return f'{self.prefix}imu_link'

    @property
    def feet(self) -> tuple[str, str]:
        """Return the links of the feet, left and right."""
        return f'{self.prefix}left_foot', f'{self.prefix}right_foot'

    @property
    def soles(self) -> tuple[str, str]:
        """Return the frames of the soles, left and right."""
        return f'{self.prefix}l_sole', f'{self.prefix}r_sole'

    @property
    def camera(self) -> str:
        """Return the optical frame of the camera."""
        return f'{self.prefix}camera_optical_frame'


def humanoid(scale: float = 1.0, prefix: str = '', hands: bool = False) -> RobotDescription:
    """
    Describe the humanoid for the simulator.

    Parameters
    ----------
    scale
        Size of the robot, as the argument of the model: 1 is the original.
    prefix
        Prefix of all link and joint names.
    hands
        Whether it has wrists and grippers.

    Raises
    ------
    DescriptionError
        There is no such model.

    """
    return RobotDescription(
        humanoid_urdf(scale, prefix, hands=hands), load_drives(scale, prefix, hands=hands), prefix
    )
