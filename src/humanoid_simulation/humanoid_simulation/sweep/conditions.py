# SPDX-License-Identifier: Apache-2.0
"""The conditions of a simulated walk: what an experiment can fix or vary, and their digest."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import lru_cache
import hashlib
import json
from typing import Any

from humanoid_common.parameters import build, parameter, ParameterError, values_of
from humanoid_control.walking.parameters import WalkParameters
from humanoid_simulation.files import scene_path
from humanoid_simulation.model.description import SELF_COLLISIONS

STEADY, RANDOM = 'steady', 'random'
SHORTEST_PUSH_PERIOD_S = 0.2
_STEADY_ONLY = (
    *('forward_m_s', 'left_m_s', 'turn_rad_s'),
    *('push_angle_rad', 'push_at_s', 'push_every_s'),
)
WALK = 'walk.'


def _mass(link: str) -> float:
    """Declare the factor on the mass of a link."""
    return parameter(
        1.0, f'Factor on mass and inertia of the link {link}.', at_least=0.1, at_most=10.0
    )


@dataclass(frozen=True)
class MassFactors:
    """Factors on the masses and inertias of links."""

    base_link: float = _mass('base_link, the pelvis')
    torso: float = _mass('torso')
    head: float = _mass('head')
    left_thigh: float = _mass('left_thigh')
    right_thigh: float = _mass('right_thigh')
    left_shank: float = _mass('left_shank')
    right_shank: float = _mass('right_shank')
    left_foot: float = _mass('left_foot')
    right_foot: float = _mass('right_foot')
    left_forearm: float = _mass('left_forearm')
    right_forearm: float = _mass('right_forearm')


@dataclass(frozen=True)
class Conditions:
    """The conditions of one walk; two walks with equal conditions are equal, bit for bit."""

    seconds: float = parameter(20.0, 'Simulated time of a run.', at_least=2.0, at_most=3600.0)
    seed: int = parameter(
        0, 'Seed of noise, drop-outs and random commands.', at_least=0, at_most=2**31 - 1
    )
    scene: str = parameter('flat', 'The terrain: an installed scene, or the path of its file.')
    friction: float = parameter(
        1.0,
        'Factor on the friction of the floor and of all objects; the floor of flat has 1.',
        at_least=0.05,
        at_most=5.0,
    )
    mass: MassFactors = MassFactors()
    hands: bool = parameter(False, 'Whether the robot has wrists and grippers.')
    load_kg: float = parameter(
        0.0,
        'What the left hand carries in front of the body; needs hands.',
        at_least=0.0,
        at_most=5.0,
    )
    self_collision: str = parameter(
        'arms', 'Which links collide with each other.', choices=tuple(SELF_COLLISIONS)
    )
    latency_periods: int = parameter(
        0, 'Age of the measurements, in control periods of 10 ms.', at_least=0, at_most=100
    )
    sensor_noise: float = parameter(
        1.0, 'Factor on realistic noise and biases of all sensors.', at_least=0.0, at_most=100.0
    )
    drop_out_chance: float = parameter(
        0.0, 'Chance of a tick that control stalls.', at_least=0.0, at_most=1.0
    )
    drop_out_ticks: int = parameter(
        10, 'Longest stall, in control periods of 10 ms.', at_least=1, at_most=100
    )
    extrapolation_s: float = parameter(
        0.03,
        'How long targets that are not renewed continue at their velocity.',
        at_least=0.0,
        at_most=1.0,
    )
    commands: str = parameter(
        STEADY,
        'steady: one velocity; random: another one every 1.5 to 5 s, with a push in each.',
        choices=(STEADY, RANDOM),
    )
    forward_m_s: float = parameter(0.25, 'Steady forward velocity.', at_least=-2.0, at_most=2.0)
    left_m_s: float = parameter(0.0, 'Steady velocity to the left.', at_least=-2.0, at_most=2.0)
    turn_rad_s: float = parameter(0.0, 'Steady yaw rate.', at_least=-3.0, at_most=3.0)
    push_ns: float = parameter(
        0.0, 'Impulse of each push at the pelvis, for 0.1 s.', at_least=0.0, at_most=200.0
    )
    push_angle_rad: float = parameter(
        0.0, 'Direction of pushes: 0 is forward, pi/2 to the left.', at_least=-7.0, at_most=7.0
    )
    push_at_s: float = parameter(3.0, 'Time of the first push.', at_least=1.0, at_most=3600.0)
    push_every_s: float = parameter(
        0.0, 'Time from push to push; 0 is a single one.', at_least=0.0, at_most=3600.0
    )
    walk: WalkParameters = WalkParameters()

    def __post_init__(self) -> None:
        """Check what must hold for several conditions together."""
        if self.load_kg and not self.hands:
            raise ParameterError(
                "'load_kg' needs 'hands: true': without hands, the robot cannot carry."
            )
        self._check_pushes()
        defaults = {each.name: each.default for each in fields(self)}
        for name in _STEADY_ONLY if self.commands == RANDOM else ():
            if getattr(self, name) != defaults[name]:
                raise ParameterError(
                    f"'{name}' has no effect with 'commands: random', which draws its own. "
                    "Remove it, or set 'commands: steady'.",
                    name,
                )

    def _check_pushes(self) -> None:
        """Check that steady pushes happen, one after the other."""
        if 0.0 < self.push_every_s < SHORTEST_PUSH_PERIOD_S:
            raise ParameterError(
                f"'push_every_s' is {self.push_every_s:g}, but a push takes 0.1 s. Give "
                f'{SHORTEST_PUSH_PERIOD_S:g} or more, or 0 for a single push.',
                'push_every_s',
            )
        if self.commands == STEADY and self.push_ns and self.push_at_s >= self.seconds:
            raise ParameterError(
                f"'push_at_s' is {self.push_at_s:g}, but a run ends after {self.seconds:g} s, so "
                "nothing would be pushed. Give less, or more 'seconds'.",
                'push_at_s',
            )

    @property
    def digest(self) -> str:
        """
        Return 16 hexadecimal digits that identify the conditions.

        The content of a scene counts, not the name of its file.
        """
        values = values_of(self) | {'scene': _content_digest(self.scene)}
        return _sha256(json.dumps(values, sort_keys=True).encode())


@dataclass(frozen=True)
class Run:
    """A run of an experiment: its conditions, and their digest, which is its key."""

    conditions: Conditions
    key: str


def conditions_of(values: dict[str, Any]) -> Conditions:
    """
    Build conditions from their values; those that are not given have their defaults.

    Parameters
    ----------
    values
        By name; names in a group contain a dot, as in `mass.torso`.

    Raises
    ------
    ParameterError
        A value is out of range, or two contradict each other.

    """
    return build(Conditions, values)


def values_to_store(conditions: Conditions) -> dict[str, Any]:
    """
    List the values of conditions for a record; parameters of the walk only where changed.

    Parameters
    ----------
    conditions
        The conditions of a run.

    Returns
    -------
    dict
        Values by name, as `conditions_of` accepts them.

    """
    default = values_of(Conditions())
    return {
        name: value
        for name, value in values_of(conditions).items()
        if not name.startswith(WALK) or value != default[name]
    }


@lru_cache
def _content_digest(scene: str) -> str:
    """Return the digest of the file of a scene."""
    return _sha256(scene_path(scene).read_bytes())


def _sha256(content: bytes) -> str:
    """Return the first 16 digits of the SHA-256 of some bytes."""
    return hashlib.sha256(content).hexdigest()[:16]
