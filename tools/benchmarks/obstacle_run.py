# SPDX-License-Identifier: Apache-2.0
"""One trial of the obstacle benchmark: the humanoid is commanded to walk into an obstacle."""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from dataclasses import dataclass
import math

from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.scene import Floor, Scene, Thing
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import numpy as np

OBSTACLE = 'obstacle'
SIDES = {'ahead': 0.0, 'behind': math.pi, 'left': math.pi / 2, 'right': -math.pi / 2}
"""The direction in which the robot walks, in rad, by the side on which the obstacle is."""
KINDS = ('wall', 'table', 'corner', 'loose')
SETTLE_S = 1.0
AFTER_S = 4.0
"""The time that the robot has to stand after the end of the command."""
PATIENCE_S = 8.0
"""The tolerated delay of the walk to the obstacle."""
_REACH_M = {'ahead': 0.2, 'behind': 0.15, 'left': 0.25, 'right': 0.25}
"""The approximate extent of the robot's body from its base."""
_LOOSE = (
    ('cylinder', (0.09, 0.3), 0.6),
    ('box', (0.2, 0.2, 0.3), 1.0),
    ('sphere', (0.12,), 0.4),
    ('box', (0.12, 0.12, 0.12), 0.2),
)


@dataclass(frozen=True)
class Trial:
    """The obstacle, and the command to walk into it."""

    number: int
    kind: str
    side: str
    speed_m_s: float
    """The commanded speed; the gait limits it to its maximum in this direction."""
    insistence_s: float
    """The time for which the command continues after the first contact."""
    friction: float
    """The friction of the floor."""
    obstacle: Thing
    distance_m: float
    """The distance from the robot's base to the obstacle."""

    @classmethod
    def drawn(cls, number: int) -> Trial:
        """
        Draw a random trial, cycling through kinds and sides.

        Parameters
        ----------
        number
            The number of the trial, which also seeds the random numbers.

        """
        random = np.random.default_rng([number, 12])
        kind = KINDS[number % len(KINDS)]
        side = tuple(SIDES)[number // len(KINDS) % len(SIDES)]
        speed = float(random.uniform(0.1, 0.5))
        distance = _REACH_M[side] + float(random.uniform(0.2, 0.6))
        return cls(
            number,
            kind,
            side,
            speed,
            float(random.uniform(1.0, 10.0)),
            float(random.uniform(0.6, 1.1)),
            _obstacle(kind, side, distance, random),
            distance,
        )

    @property
    def velocity(self) -> tuple[float, float]:
        """The commanded velocity in m/s, forward and to the left."""
        way = self.speed_m_s * cmath.exp(1j * SIDES[self.side])
        return way.real, way.imag


@dataclass(frozen=True)
class TrialResult:
    """The result of a trial."""

    trial: Trial
    touched_s: float | None
    """The time of the first contact with the obstacle."""
    reported_s: float | None
    """The time when the walk first reported that its way is blocked."""
    fell_s: float | None
    leaned_rad: float
    """The maximum tilt of the base."""

    @property
    def fell(self) -> bool:
        """Whether the robot fell."""
        return self.fell_s is not None


def run_trial(trial: Trial) -> TrialResult:
    """
    Walk a robot into the obstacle, continue, stop, and check whether it remains standing.

    Parameters
    ----------
    trial
        The obstacle and the command.

    """
    settings = BackendSettings(noise=REALISTIC, seed=trial.number)
    scene = Scene(floor=Floor(friction=trial.friction), things=(trial.obstacle,))
    return _Run(trial, LockstepRobot(settings, scene)).result()


class _Run:
    """A robot on its way into an obstacle."""

    def __init__(self, trial: Trial, robot: LockstepRobot) -> None:
        self._trial, self._robot = trial, robot
        self._touched_s: float | None = None
        self._reported_s: float | None = None
        self._leaned_rad = 0.0

    def result(self) -> TrialResult:
        """Run the trial."""
        stands = all(self._ticks())
        fell_s = None if stands else self._robot.backend.time_s
        return TrialResult(
            self._trial, self._touched_s, self._reported_s, fell_s, self._leaned_rad
        )

    def _ticks(self) -> Iterator[bool]:
        """Yield whether the robot is on its feet, tick by tick."""
        robot, trial = self._robot, self._trial
        yield from self._during(SETTLE_S)
        robot.drive(*trial.velocity)
        latest_s = robot.backend.time_s + trial.distance_m / 0.1 + PATIENCE_S
        while self._touched_s is None and robot.backend.time_s < latest_s:
            yield self._tick()
            if self._touches():
                self._touched_s = robot.backend.time_s
        yield from self._during(trial.insistence_s)
        robot.drive()
        yield from self._during(AFTER_S)

    def _during(self, duration_s: float) -> Iterator[bool]:
        for _ in range(round(duration_s / self._robot.backend.period_s)):
            yield self._tick()

    def _tick(self) -> bool:
        robot = self._robot
        robot.tick()
        if self._reported_s is None and robot.walking.walker.is_blocked:
            self._reported_s = robot.backend.time_s
        self._leaned_rad = max(self._leaned_rad, robot.tilt_rad)
        return robot.stands

    def _touches(self) -> bool:
        """Whether the robot touches the obstacle."""
        return any(
            OBSTACLE in (contact.body1, contact.body2)
            and {contact.body1, contact.body2} & set(self._robot.backend.links())
            for contact in self._robot.backend.contacts()
        )


def _obstacle(kind: str, side: str, distance_m: float, random: np.random.Generator) -> Thing:
    """Create an obstacle whose front is at a given distance from the robot's base."""
    ahead = cmath.exp(1j * SIDES[side])
    turn_rad = float(random.uniform(-0.35, 0.35))
    if kind == 'loose':
        shape, size, mass_kg = _LOOSE[random.integers(len(_LOOSE))]
        height_m = size[-1] if shape != 'sphere' else 2 * size[0]
        half_m = size[0] / 2 if shape == 'box' else size[0]
        aside_m = float(random.uniform(-0.15, 0.15))
        place = (distance_m + half_m + 1j * aside_m) * ahead
        return _thing(shape, size, place, height_m / 2, turn_rad, mass_kg)
    if kind == 'corner':
        size = (0.8, 0.3, 1.0)
        turn_rad = float(random.uniform(math.radians(30), math.radians(60)))
        # With this rotation, the corner at minus half of both edges is the nearest one.
        corner = complex(size[0], size[1]) / 2 * cmath.exp(1j * turn_rad)
        place = distance_m + 1j * float(random.uniform(-0.2, 0.2)) + corner
        return _thing('box', size, place * ahead, size[2] / 2, turn_rad + SIDES[side])
    if kind == 'table':
        height_m = float(random.choice([0.4, 0.5, 0.75]))
        thick_m = height_m if random.random() < 0.5 else 0.04
        size = (0.6, 1.6, thick_m)
        place = (distance_m + size[0] / 2) * ahead
        return _thing('box', size, place, height_m - thick_m / 2, turn_rad + SIDES[side])
    size = (0.1, 3.0, 1.2)
    return _thing('box', size, (distance_m + size[0] / 2) * ahead, 0.6, turn_rad + SIDES[side])


def _thing(
    shape: str,
    size_m: tuple[float, ...],
    place: complex,
    height_m: float,
    yaw_rad: float,
    mass_kg: float = 0.0,
) -> Thing:
    return Thing(
        OBSTACLE,
        shape,
        size_m,
        (place.real, place.imag, height_m),
        (0.0, 0.0, yaw_rad),
        mass_kg=mass_kg,
    )
