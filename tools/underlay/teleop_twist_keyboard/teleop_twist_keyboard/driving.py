# SPDX-License-Identifier: Apache-2.0
"""What the keys mean: directions, and changes of the speeds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

__all__ = ['HELP', 'Driving', 'Velocity']

HELP = """\
This node takes keypresses from the keyboard and publishes them
as Twist/TwistStamped messages. It works best with a US keyboard layout.
---------------------------
Moving around:
   u    i    o
   j    k    l
   m    ,    .

For Holonomic mode (strafing), hold down the shift key:
---------------------------
   U    I    O
   J    K    L
   M    <    >

t : up (+z)
b : down (-z)

anything else : stop

q/z : increase/decrease max speeds by 10%
w/x : increase/decrease only linear speed by 10%
e/c : increase/decrease only angular speed by 10%

CTRL-C to quit
"""


class Velocity(NamedTuple):
    """Linear velocity in m/s, forward, to the left and up, and yaw rate in rad/s."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    yaw: float = 0.0


_DIRECTIONS = {
    'i': Velocity(x=1),
    'o': Velocity(x=1, yaw=-1),
    'j': Velocity(yaw=1),
    'l': Velocity(yaw=-1),
    'u': Velocity(x=1, yaw=1),
    ',': Velocity(x=-1),
    '.': Velocity(x=-1, yaw=1),
    'm': Velocity(x=-1, yaw=-1),
    'I': Velocity(x=1),
    'O': Velocity(x=1, y=-1),
    'J': Velocity(y=1),
    'L': Velocity(y=-1),
    'U': Velocity(x=1, y=1),
    '<': Velocity(x=-1),
    '>': Velocity(x=-1, y=-1),
    'M': Velocity(x=-1, y=1),
    't': Velocity(z=1),
    'b': Velocity(z=-1),
}
_FACTORS = {
    'q': (1.1, 1.1),
    'z': (0.9, 0.9),
    'w': (1.1, 1.0),
    'x': (0.9, 1.0),
    'e': (1.0, 1.1),
    'c': (1.0, 0.9),
}


@dataclass
class Driving:
    """
    The direction and the speeds that keys have chosen.

    Parameters
    ----------
    speed_m_s
        The linear speed.
    turn_rad_s
        The angular speed.

    """

    speed_m_s: float = 0.5
    turn_rad_s: float = 1.0

    def __post_init__(self) -> None:
        """Begin at rest."""
        self._direction = Velocity()

    def press(self, key: str) -> str:
        """
        Change direction or speeds; a key without a meaning stops.

        Parameters
        ----------
        key
            The key.

        Returns
        -------
        str
            What to show: the speeds if they have changed, else ''.

        """
        if key not in _FACTORS:
            self._direction = _DIRECTIONS.get(key, Velocity())
            return ''
        linear, angular = _FACTORS[key]
        self.speed_m_s *= linear
        self.turn_rad_s *= angular
        return self.speeds

    @property
    def speeds(self) -> str:
        """The speeds, to be shown."""
        return f'currently:\tspeed {self.speed_m_s:.4g}\tturn {self.turn_rad_s:.4g}'

    @property
    def velocity(self) -> Velocity:
        """The velocity to be published."""
        x, y, z, yaw = self._direction
        return Velocity(
            x * self.speed_m_s, y * self.speed_m_s, z * self.speed_m_s, yaw * self.turn_rad_s
        )
