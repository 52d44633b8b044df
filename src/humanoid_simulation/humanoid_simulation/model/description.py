# SPDX-License-Identifier: Apache-2.0
"""What a world is built from besides its scene: robots, their places and names, and physics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
import math

from humanoid_description.drives import Drive, load_drives, SIDES
from humanoid_description.expansion import humanoid_urdf
from humanoid_simulation.errors import named, SimulationError

ALONE = 'robot'
"""Name of an unnamed robot among the entities of the world."""
ACCELEROMETER = 'accelerometer'
CAMERA = 'head_camera'
FLOATING_BASE = 'floating_base'
SELF_COLLISIONS: Mapping[str, str] = {
    'none': 'the links of a robot pass through each other',
    'arms': 'arms collide with trunk, head, thighs and each other',
    'all': 'legs collide with each other as well',
}


@dataclass(frozen=True)
class Physics:
    """Time step, self-collisions, mass factors and sleeping of the physics."""

    period_s: float = 0.002
    self_collision: str = 'arms'
    mass_factors: Mapping[str, float] = field(default_factory=dict)
    """Factors by which the mass and inertia of links are multiplied, by link."""
    sleep: bool = True
    """
    Whether objects at rest sleep, together with their contacts, until something touches or moves
    them; that saves most of their cost. Robots never sleep.
    """

    def __post_init__(self) -> None:
        """Validate the settings."""
        named('self-collision mode', self.self_collision, SELF_COLLISIONS)
        if not 1e-4 <= self.period_s <= 0.01:
            raise SimulationError(
                f'A physics period of {self.period_s:g} s is not possible. Give 0.0001 to 0.01 s; '
                '0.002 s is a good default.'
            )
        for link, factor in self.mass_factors.items():
            if not 0.01 <= factor <= 100.0:
                raise SimulationError(
                    f"The mass factor of link '{link}' cannot be {factor:g}. Give 0.01 to 100."
                )


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


@dataclass(frozen=True)
class Placement:
    """A robot's name, which is its namespace, and its initial pose on the ground."""

    robot: str = ''
    x_m: float = 0.0
    y_m: float = 0.0
    z_m: float = 0.0
    """The height of the ground there."""
    yaw_rad: float = 0.0


def check_placements(placements: Sequence[Placement]) -> None:
    """
    Check that robots have unique names and finite positions.

    Parameters
    ----------
    placements
        One for each robot.

    Raises
    ------
    SimulationError
        There is no robot, a name is duplicated or missing, or a position is not finite.

    """
    if not placements:
        raise SimulationError('There is no robot to simulate. Name at least one.')
    names = [placement.robot for placement in placements]
    for name in names:
        if names.count(name) > 1:
            raise SimulationError(f"Two robots are named '{name}'. Give each robot a unique name.")
        if name == '' and len(names) > 1:
            raise SimulationError(
                'With several robots, each robot needs a name, which is its namespace.'
            )
    for place in placements:
        if not all(map(math.isfinite, (place.x_m, place.y_m, place.z_m, place.yaw_rad))):
            raise SimulationError(
                f"The initial pose of robot '{place.robot}' is not finite: {place}."
            )


def in_world(robot: str, name: str) -> str:
    """
    Compute the name of a link, joint, sensor or camera of a robot in the MuJoCo model.

    Parameters
    ----------
    robot
        Name of the robot; '' if it has none.
    name
        Name of this element in the description, with the robot's prefix.

    """
    return f'{robot or ALONE}/{name}'
