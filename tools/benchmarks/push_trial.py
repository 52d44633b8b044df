# SPDX-License-Identifier: Apache-2.0
"""One push to the side of a robot that walks, at a moment of its step."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.walking.sides import NAMES
from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.model import Physics
from humanoid_simulation.testing.lockstep_robot import LockstepRobot

BEGIN_S = 3.0
WATCH_S = 4.0
DIRECTIONS = {'left': 1j, 'right': -1j}


@dataclass(frozen=True)
class PushTrial:
    """What is done to the robot."""

    impulse_ns: float
    direction: str
    support: int
    """The foot that carries the robot, or takes its weight, when the push begins."""
    phase: float
    """The share of the step that has passed then: it begins when the other foot lands."""
    speed_m_s: float = 0.3
    noise: float = 0.0
    seed: int = 0
    hands: bool = False

    @property
    def is_outwards(self) -> bool:
        """Whether the push is to the side of the foot that carries: the other one must cross."""
        return NAMES[self.support] == self.direction


def stands_after(trial: PushTrial) -> bool:
    """
    Walk a robot and push it; return whether it still stands `WATCH_S` later.

    Parameters
    ----------
    trial
        The push, and how the robot walks.

    Raises
    ------
    RuntimeError
        The robot does not walk when it is to be pushed.

    """
    # Legs that pass through each other would make it easy to cross them.
    settings = BackendSettings(
        Physics(self_collision='all'), noise=REALISTIC.scaled(trial.noise), seed=trial.seed
    )
    robot = LockstepRobot(settings, hands=trial.hands)
    robot.wait(1.0)
    robot.drive(trial.speed_m_s)
    robot.wait(BEGIN_S)
    _wait_for_step(robot, trial.support)
    step_s = robot.walking.walker.parameters.step_s
    robot.wait(trial.phase * step_s)
    robot.push(DIRECTIONS[trial.direction], trial.impulse_ns)
    return robot.wait(WATCH_S)


def _wait_for_step(robot: LockstepRobot, support: int) -> None:
    """Wait until the next step on a foot begins."""
    while _support(robot) == support:
        robot.tick()
    while _support(robot) != support:
        robot.tick()


def _support(robot: LockstepRobot) -> int:
    """Return the foot that carries the robot, or is about to."""
    status = robot.walking.walker.status
    if status is None or not status.footsteps:
        raise RuntimeError('The robot does not walk.')
    return 1 - status.footsteps[0].side
