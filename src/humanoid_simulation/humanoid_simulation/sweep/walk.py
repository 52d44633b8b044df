# SPDX-License-Identifier: Apache-2.0
"""One run of a sweep: a robot that walks in lockstep with its world, without ROS."""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from dataclasses import dataclass, replace
import math
import time

from humanoid_common.errors import UserError
from humanoid_control.controllers import TrajectoryPoint, TrajectoryRequest
from humanoid_control.walking import VelocityCommand
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.model import Physics
from humanoid_simulation.scene.loading import load_scene
from humanoid_simulation.scene.scene import Scene
from humanoid_simulation.sweep.conditions import Conditions, RANDOM, Run
from humanoid_simulation.sweep.results import FAILED, FELL, RunResult, STOOD
from humanoid_simulation.testing.lockstep_robot import DropOuts, LockstepRobot
import numpy as np

SETTLE_S = 1.0
"""Time of standing at the start of a run."""
HAND_LINK, HAND_KG = 'left_palm', 0.3
ARM = 'left_arm_controller'
CARRYING_RAD = (0.2, 0.15, 0.0, -1.77, 0.0, 0.0)
"""Arm posture for carrying: the upper arm hangs, and the forearm is level."""
_WAY_S = 0.5
_COMMANDS_STREAM, _STALLS_STREAM = 2, 3


@dataclass(frozen=True)
class Segment:
    """A velocity command for some time, with one push."""

    command: VelocityCommand
    duration_s: float
    push_after_s: float = 0.0
    impulse_ns: complex = 0j
    """In the world frame, or relative to the heading of the robot."""
    is_relative: bool = False


def random_segment(random: np.random.Generator, push_ns: float) -> Segment:
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


def segments_of(conditions: Conditions) -> Iterator[Segment]:
    """
    Yield the commands of a run without an end: standing, then steady or random ones.

    Parameters
    ----------
    conditions
        The conditions of the run.

    """
    yield Segment(VelocityCommand(), SETTLE_S)
    if conditions.commands == RANDOM:
        random = np.random.default_rng([conditions.seed, _COMMANDS_STREAM])
        while True:
            yield random_segment(random, conditions.push_ns)
    command = VelocityCommand(conditions.forward_m_s, conditions.left_m_s, conditions.turn_rad_s)
    push = cmath.rect(conditions.push_ns, conditions.push_angle_rad)
    every_s = conditions.push_every_s or conditions.seconds
    wait_s = conditions.push_at_s - SETTLE_S
    yield Segment(command, wait_s + every_s, wait_s, push, is_relative=True)
    while True:
        yield Segment(command, every_s, 0.0, push, is_relative=True)


class Walk:
    """
    A robot in a world of its own, built from the conditions of a run.

    Parameters
    ----------
    conditions
        The conditions of the run.

    Attributes
    ----------
    robot
        The robot, in lockstep with its world.
    segment
        The current command.
    push_ns, push_s
        The last push, in the world frame, and when it began; 0 without.

    Raises
    ------
    SimulationError, WalkingError
        Such a world or such a walk is not possible.

    """

    def __init__(self, conditions: Conditions) -> None:
        self.conditions = conditions
        self.robot = LockstepRobot(
            _settings(conditions),
            scene_of(conditions),
            DropOuts(
                np.random.default_rng([conditions.seed, _STALLS_STREAM]),
                conditions.drop_out_chance,
                conditions.drop_out_ticks,
            ).misses,
            conditions.hands,
            conditions.walk,
        )
        if conditions.load_kg:
            self._hold_hand_before_body()
        self.segment = Segment(VelocityCommand(), 0.0)
        self.push_ns, self.push_s = 0j, 0.0
        self._has_fallen, self._phase = False, ''
        self._distance_m, self._tilt_rad = 0.0, 0.0
        self._blocked, self._was_blocked = 0, False

    def ticks(self) -> Iterator[None]:
        """Walk; yield after each control period, until the time is over or the robot falls."""
        backend, end_s = self.robot.backend, self.conditions.seconds
        for segment in segments_of(self.conditions):
            if self._has_fallen or backend.time_s >= end_s - backend.period_s:
                return
            yield from self._obey(segment, end_s - backend.time_s)

    def result(self, cpu_s: float = 0.0) -> RunResult:
        """
        Return the result of the walk so far.

        Parameters
        ----------
        cpu_s
            CPU time of the walk.

        """
        pose, command = self.robot.pose, self.segment.command
        return RunResult(
            outcome=FELL if self._has_fallen else STOOD,
            survived_s=self.robot.backend.time_s,
            distance_m=self._distance_m,
            largest_tilt_rad=self._tilt_rad,
            end_x_m=pose.position_m.real,
            end_y_m=pose.position_m.imag,
            end_yaw_rad=pose.yaw_rad,
            blocked=self._blocked,
            phase=self._phase,
            forward_m_s=command.forward_m_s,
            left_m_s=command.left_m_s,
            turn_rad_s=command.turn_rad_s,
            push_x_ns=self.push_ns.real,
            push_y_ns=self.push_ns.imag,
            push_s=self.push_s,
            cpu_s=cpu_s,
        )

    def _hold_hand_before_body(self) -> None:
        """Raise the left hand to the carrying posture."""
        control = self.robot.walking.control
        arm = control.goals.limbs[ARM]
        request = TrajectoryRequest(arm.own, [TrajectoryPoint(SETTLE_S, CARRYING_RAD)])
        arm.accept(control.goals.checked_goal(ARM, request), lambda end: None)

    def _obey(self, segment: Segment, at_most_s: float) -> Iterator[None]:
        """Execute a command."""
        robot, command = self.robot, segment.command
        self.segment = segment
        robot.drive(command.forward_m_s, command.left_m_s, command.turn_rad_s)
        duration_s = min(segment.duration_s, at_most_s)
        before_s = min(segment.push_after_s, duration_s)
        yield from self._walk(before_s)
        if self._has_fallen:
            return
        if segment.impulse_ns and before_s < duration_s:
            self._push(segment)
        yield from self._walk(duration_s - before_s)

    def _push(self, segment: Segment) -> None:
        """Push the robot."""
        turn = cmath.rect(1.0, self.robot.pose.yaw_rad) if segment.is_relative else 1.0
        self.push_ns, self.push_s = segment.impulse_ns * turn, self.robot.backend.time_s
        self.robot.push(self.push_ns / abs(self.push_ns), abs(self.push_ns))

    def _walk(self, duration_s: float) -> Iterator[None]:
        """Walk for some time, and accumulate the distance, in steps of half a second."""
        period_s = self.robot.backend.period_s
        left, piece = round(duration_s / period_s), round(_WAY_S / period_s)
        while left > 0 and not self._has_fallen:
            place = self.robot.pose.position_m
            for _ in range(min(left, piece)):
                self.robot.tick()
                self._has_fallen = not self.robot.stands
                self._note_phase()
                self._tilt_rad = max(self._tilt_rad, self.robot.tilt_rad)
                yield
                if self._has_fallen:
                    break
            self._distance_m += abs(self.robot.pose.position_m - place)
            self._count_blocks()
            left -= piece

    def _note_phase(self) -> None:
        """Keep the phase of the walk, until it notices that it falls."""
        walker = self.robot.walking.walker
        if not walker.has_fallen:
            self._phase = walker.phase or ''

    def _count_blocks(self) -> None:
        """Count how often the way is blocked, which lasts at least half a second."""
        is_blocked = self.robot.walking.walker.is_blocked
        self._blocked += is_blocked and not self._was_blocked
        self._was_blocked = is_blocked


def walk(run: Run) -> RunResult:
    """
    Do one run.

    Parameters
    ----------
    run
        The run.

    Returns
    -------
    RunResult
        Its result; if it cannot be simulated, the outcome is `failed`, with the reason.

    """
    begin_s = time.process_time()
    try:
        each = Walk(run.conditions)
    except UserError as error:
        return RunResult(FAILED, 0.0, problem=str(error))
    try:
        for _ in each.ticks():
            pass
    except UserError as error:
        failed = replace(each.result(), outcome=FAILED, problem=str(error))
        return replace(failed, cpu_s=time.process_time() - begin_s)
    return each.result(time.process_time() - begin_s)


def scene_of(conditions: Conditions) -> Scene:
    """
    Load the scene of a run, with the friction of its floor and objects.

    Parameters
    ----------
    conditions
        The conditions of the run.

    Raises
    ------
    SimulationError
        There is no such scene, or it has a mistake.

    """
    scene, factor = load_scene(conditions.scene), conditions.friction
    if factor == 1.0:
        return scene
    return replace(
        scene,
        floor=replace(scene.floor, friction=scene.floor.friction * factor),
        things=tuple(replace(thing, friction=thing.friction * factor) for thing in scene.things),
    )


def _settings(conditions: Conditions) -> BackendSettings:
    """Build the settings of the simulation."""
    masses = {link: factor for link, factor in vars(conditions.mass).items() if factor != 1.0}
    if conditions.load_kg:
        masses[HAND_LINK] = 1.0 + conditions.load_kg / HAND_KG
    return BackendSettings(
        Physics(self_collision=conditions.self_collision, mass_factors=masses),
        noise=REALISTIC.scaled(conditions.sensor_noise),
        seed=conditions.seed,
        latency_periods=conditions.latency_periods,
        extrapolation_s=conditions.extrapolation_s,
    )
