# SPDX-License-Identifier: Apache-2.0
"""A lateral push of a walking robot, at a given phase of its step."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.model import Physics
from humanoid_simulation.testing.lockstep_robot import LockstepRobot

BEGIN_S = 3.0
WATCH_S = 4.0
DIRECTIONS = {'left': 1j, 'right': -1j}


@dataclass(frozen=True)
class PushTrial:
    """The parameters of a push."""

    impulse_ns: float
    direction: str
    support: int
    """The stance foot, or the foot being loaded, when the push starts."""
    phase: float
    """The phase of the step at that time, from 0 when the other foot lands."""
    speed_m_s: float = 0.3
    noise: float = 0.0
    seed: int = 0
    hands: bool = False


def stands_after(trial: PushTrial) -> bool:
    """
    Walk a robot and push it; return whether it still stands `WATCH_S` later.

    Parameters
    ----------
    trial
        The push, and the gait of the robot.

    Raises
    ------
    RuntimeError
        The robot is not walking when it is to be pushed.

    """
    # If legs could pass through each other, crossing them would be too easy.
    settings = BackendSettings(
        Physics(self_collision='all'), noise=REALISTIC.scaled(trial.noise), seed=trial.seed
    )
    robot = LockstepRobot(settings, hands=trial.hands)
    robot.wait(1.0)
    robot.drive(trial.speed_m_s)
    robot.wait(BEGIN_S)
    _wait_for_step(robot, trial.support)
    step_s = robot.walking.walker.parameters.timing.step_s
    robot.wait(trial.phase * step_s)
    robot.push(DIRECTIONS[trial.direction], trial.impulse_ns)
    return robot.wait(WATCH_S)


def _wait_for_step(robot: LockstepRobot, support: int) -> None:
    """Wait until the next step on a foot starts."""
    while _support(robot) == support:
        robot.tick()
    while _support(robot) != support:
        robot.tick()


def _support(robot: LockstepRobot) -> int:
    """Return the current or next stance foot."""
    status = robot.walking.walker.status
    if status is None or not status.footsteps:
        raise RuntimeError('The robot does not walk.')
    return 1 - status.footsteps[0].side
