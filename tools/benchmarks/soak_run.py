# SPDX-License-Identifier: Apache-2.0
"""One run of the walking soak: random commands and pushes under random conditions."""

from __future__ import annotations

from dataclasses import dataclass, replace
import math

from humanoid_control.walking import VelocityCommand, Walker, WalkParameters
from humanoid_description.loading import load_robot
from humanoid_simulation.backend import BackendSettings, MujocoBackend
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.examples.fall_watch import FallWatch, tilt_rad
from humanoid_simulation.model import humanoid, Physics
from humanoid_simulation.scene import Scene
from humanoid_simulation.scene.scene import Floor
import numpy as np

MASS_LINK = 'torso'
SETTLE_S = 1.0
PUSH_S = 0.1
EXTRAPOLATION_S = 0.1


@dataclass(frozen=True)
class Conditions:
    """What differs from run to run."""

    seed: int
    friction: float
    mass_factor: float
    latency_periods: int

    @classmethod
    def drawn(cls, seed: int) -> Conditions:
        """Draw friction 0.5 to 1.1, the trunk's mass +-20 %, and up to 20 ms of latency."""
        random = np.random.default_rng([seed, 1])
        return cls(
            seed,
            float(random.uniform(0.5, 1.1)),
            float(random.uniform(0.8, 1.2)),
            int(random.integers(0, 3)),
        )


@dataclass(frozen=True)
class Segment:
    """A command for a while, in which the robot is pushed once."""

    command: VelocityCommand
    duration_s: float
    push_after_s: float
    impulse_ns: complex


@dataclass(frozen=True)
class SoakResult:
    """How a run ended; where it walked and what it was told last."""

    conditions: Conditions
    survived_s: float
    fell: bool
    distance_m: float
    last: Segment
    phase: str


def drawn_segment(random: np.random.Generator, push_ns: float) -> Segment:
    """Draw a command of one of six kinds, and a push in any direction."""
    forward, left, turn = (
        (0.0, 0.0, 0.0),
        (random.uniform(-0.2, 0.35), 0.0, 0.0),
        (0.0, random.uniform(-0.12, 0.12), 0.0),
        (0.0, 0.0, random.uniform(-0.6, 0.6)),
        (random.uniform(0.0, 0.3), random.uniform(-0.08, 0.08), random.uniform(-0.4, 0.4)),
        (random.uniform(0.2, 0.35), 0.0, random.uniform(-0.3, 0.3)),
    )[random.integers(6)]
    duration_s = float(random.uniform(1.5, 5.0))
    angle_rad = random.uniform(0.0, 2 * math.pi)
    return Segment(
        VelocityCommand(float(forward), float(left), float(turn)),
        duration_s,
        float(random.uniform(0.0, duration_s - 0.2)),
        push_ns * complex(math.cos(angle_rad), math.sin(angle_rad)),
    )


class SoakRun:
    """A robot that walks in a world of its own, without ROS."""

    def __init__(self, conditions: Conditions, push_ns: float, drop_outs: float) -> None:
        """Make the world; `drop_outs` is the share of the ticks at which the controller stalls."""
        self._conditions, self._push_ns, self._drop_outs = conditions, push_ns, drop_outs
        description = humanoid()
        physics = Physics(mass_factors={MASS_LINK: conditions.mass_factor})
        settings = BackendSettings(
            physics,
            noise=REALISTIC,
            seed=conditions.seed,
            latency_periods=conditions.latency_periods,
            extrapolation_s=EXTRAPOLATION_S,
        )
        scene = replace(Scene(), floor=Floor(friction=conditions.friction))
        self._backend = MujocoBackend(description, scene, settings=settings)
        robot, joints = load_robot(description.urdf, 'the humanoid'), self._backend.joints
        self._walker = Walker.of(robot, description.drives, joints, WalkParameters())
        self._random = np.random.default_rng([conditions.seed, 2])
        self._fall_watch = FallWatch()
        self._stalled_ticks = 0
        self._distance_m = 0.0
        self._place = self._look()[0]

    def run(self, duration_s: float) -> SoakResult:
        """Walk until the time is over or the robot falls."""
        segment = Segment(VelocityCommand(), SETTLE_S, math.inf, 0j)
        fell = self._walk(segment, duration_s)
        while not fell and self._backend.time_s < duration_s - self._backend.period_s:
            segment = drawn_segment(self._random, self._push_ns)
            fell = self._walk(segment, duration_s)
        status = self._walker.status
        return SoakResult(
            self._conditions,
            self._backend.time_s,
            fell,
            self._distance_m,
            segment,
            status.phase if status else '',
        )

    def _walk(self, segment: Segment, until_s: float) -> bool:
        """Obey a command, until a time at most; return whether the robot fell."""
        self._walker.command(segment.command)
        period_s, left_s = self._backend.period_s, until_s - self._backend.time_s
        push_tick = segment.push_after_s / period_s
        for tick in range(round(min(segment.duration_s, left_s) / period_s)):
            if tick <= push_tick < tick + 1:
                force_n = segment.impulse_ns / PUSH_S
                self._backend.apply_wrench('base_link', (force_n.real, force_n.imag, 0.0))
            self._tick()
            if not self._stands():
                return True
        return False

    def _tick(self) -> None:
        """Observe, decide and go on, unless the controller stalls."""
        if self._stalls():
            self._backend.step({})
            return
        observation = self._backend.observe()['']
        self._backend.step({'': self._walker.update(observation)})

    def _stalls(self) -> bool:
        """Tell whether a tick is missed; a stall lasts up to 100 ms."""
        if self._stalled_ticks == 0 and self._random.random() < self._drop_outs:
            self._stalled_ticks = int(self._random.integers(1, 11))
        if self._stalled_ticks == 0:
            return False
        self._stalled_ticks -= 1
        return True

    def _stands(self) -> bool:
        """Tell whether the robot is on its feet, and add to its way."""
        place, height_m, lean_rad = self._look()
        self._distance_m += abs(place - self._place)
        self._place = place
        return self._fall_watch.stands(height_m, lean_rad)

    def _look(self) -> tuple[complex, float, float]:
        """Return where the base really is, how high, and how much it leans."""
        state = self._backend.ground_truth()
        x, y, height_m = state.position_m.tolist()
        w, *vector = state.orientation.tolist()
        return complex(x, y), height_m, tilt_rad(*vector, w)
