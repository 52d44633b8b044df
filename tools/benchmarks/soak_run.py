# SPDX-License-Identifier: Apache-2.0
"""One run of the walking soak: random commands and pushes under random conditions."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.controllers import TrajectoryPoint, TrajectoryRequest
from humanoid_control.walking import VelocityCommand
from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.model import Physics
from humanoid_simulation.scene import Scene
from humanoid_simulation.scene.scene import Floor
from humanoid_simulation.testing.lockstep_robot import DropOuts, LockstepRobot
import numpy as np

MASS_LINK = 'torso'
HAND_LINK, HAND_KG = 'left_palm', 0.3
ARM = 'left_arm_controller'
CARRYING_RAD = (0.2, 0.15, 0.0, -1.77, 0.0, 0.0)
"""Arm posture for carrying: the upper arm hangs, and the forearm is level."""
SETTLE_S = 1.0
WAY_S = 0.5
LONGEST_STALL_TICKS = 10
EXTRAPOLATION_S = 0.03
"""The default of the simulator: a fast foot extrapolated for longer misses its foothold."""


@dataclass(frozen=True)
class Conditions:
    """The random conditions of a run."""

    seed: int
    friction: float
    mass_factor: float
    latency_periods: int

    @classmethod
    def drawn(cls, seed: int) -> Conditions:
        """
        Draw friction 0.5 to 1.1, the trunk's mass +-20 %, and up to 20 ms of latency.

        Parameters
        ----------
        seed
            The seed of the random numbers; the same seed gives the same conditions.

        """
        random = np.random.default_rng([seed, 1])
        return cls(
            seed,
            float(random.uniform(0.5, 1.1)),
            float(random.uniform(0.8, 1.2)),
            int(random.integers(0, 3)),
        )


@dataclass(frozen=True)
class Segment:
    """A velocity command for some time, with one push."""

    command: VelocityCommand
    duration_s: float
    push_after_s: float
    impulse_ns: complex


@dataclass(frozen=True)
class SoakResult:
    """The result of a run, with the distance walked and the last command."""

    conditions: Conditions
    survived_s: float
    fell: bool
    distance_m: float
    last: Segment
    phase: str
    alarms: int
    """The number of false alarms of a blocked way."""


def drawn_segment(random: np.random.Generator, push_ns: float) -> Segment:
    """
    Draw a command of one of six kinds, and a push in any direction.

    Parameters
    ----------
    random
        The source of random numbers.
    push_ns
        The impulse of the push in N s; 0 for none.

    """
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
    """
    A robot that walks in its own world, without ROS.

    Parameters
    ----------
    conditions, push_ns
        The conditions of the run, and the impulse of the pushes in N s.
    drop_outs
        The probability per tick that control starts to stall.
    hands
        Whether the robot has wrists and grippers.
    load_kg
        The load of the left hand, held in front of the body; only with hands.

    """

    def __init__(
        self,
        conditions: Conditions,
        push_ns: float,
        drop_outs: float,
        hands: bool = False,
        load_kg: float = 0.0,
    ) -> None:
        self._conditions, self._push_ns = conditions, push_ns
        masses = {MASS_LINK: conditions.mass_factor}
        if load_kg:
            masses[HAND_LINK] = 1.0 + load_kg / HAND_KG
        settings = BackendSettings(
            Physics(mass_factors=masses),
            noise=REALISTIC,
            seed=conditions.seed,
            latency_periods=conditions.latency_periods,
            extrapolation_s=EXTRAPOLATION_S,
        )
        scene = Scene(floor=Floor(friction=conditions.friction))
        stalls = np.random.default_rng([conditions.seed, 3])
        misses = DropOuts(stalls, drop_outs, LONGEST_STALL_TICKS).misses
        self._robot = LockstepRobot(settings, scene, misses, hands)
        if load_kg:
            self._hold_hand_before_body()
        self._random = np.random.default_rng([conditions.seed, 2])
        self._distance_m = 0.0
        self._alarms, self._was_blocked = 0, False

    def _hold_hand_before_body(self) -> None:
        """Raise the left hand to the carrying posture."""
        control = self._robot.walking.control
        arm = control.goals.limbs[ARM]
        request = TrajectoryRequest(arm.own, [TrajectoryPoint(SETTLE_S, CARRYING_RAD)])
        arm.accept(control.goals.checked_goal(ARM, request), lambda end: None)

    def run(self, duration_s: float) -> SoakResult:
        """
        Walk with random commands until the time is over or the robot falls.

        Parameters
        ----------
        duration_s
            The maximum duration, in simulated time.

        """
        backend = self._robot.backend
        segment = Segment(VelocityCommand(), SETTLE_S, 0.0, 0j)
        stands = self._obey(segment, duration_s)
        while stands and backend.time_s < duration_s - backend.period_s:
            segment = drawn_segment(self._random, self._push_ns)
            stands = self._obey(segment, duration_s - backend.time_s)
        status = self._robot.walking.walker.status
        phase = status.phase if status else ''
        return SoakResult(
            self._conditions,
            backend.time_s,
            not stands,
            self._distance_m,
            segment,
            phase,
            self._alarms,
        )

    def _obey(self, segment: Segment, at_most_s: float) -> bool:
        """Execute a command; return whether the robot is on its feet at the end."""
        robot, command = self._robot, segment.command
        robot.drive(command.forward_m_s, command.left_m_s, command.turn_rad_s)
        duration_s = min(segment.duration_s, at_most_s)
        before_s = min(segment.push_after_s, duration_s)
        if not self._walk(before_s):
            return False
        if segment.impulse_ns:
            robot.push(segment.impulse_ns / abs(segment.impulse_ns), abs(segment.impulse_ns))
        return self._walk(duration_s - before_s)

    def _walk(self, duration_s: float) -> bool:
        """Walk for some time, and accumulate the distance, in steps of half a second."""
        left_s = duration_s
        while left_s > 0.0:
            place = self._robot.pose.position_m
            stands = self._robot.wait(min(left_s, WAY_S))
            self._distance_m += abs(self._robot.pose.position_m - place)
            self._count_alarms()
            if not stands:
                return False
            left_s -= WAY_S
        return True

    def _count_alarms(self) -> None:
        """Count the alarms of a blocked way, each of which lasts at least half a second."""
        is_blocked = self._robot.walking.walker.is_blocked
        self._alarms += is_blocked and not self._was_blocked
        self._was_blocked = is_blocked
