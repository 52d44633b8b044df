# SPDX-License-Identifier: Apache-2.0
"""Let the humanoid get up from random lying postures, and count how often it stands.

Each trial drops the robot, limp and with its joints at random, onto its back, its face or a side.
The table says for each of these how often it stands by itself within the time, and how long that
took, from when it begins. There is no ROS: controller and physics run in lockstep, as fast as
possible. The status is 1 if it stands less often than is asked for.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
import math
import multiprocessing
import sys

from arguments import in_range
from humanoid_control.walking.get_up import BACK, FACE, LEFT_SIDE, RIGHT_SIDE
from humanoid_description.drives import load_drives
from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.keyframes import Keyframe
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import numpy as np

LYING = {
    BACK: (0.0, -math.pi / 2.0),
    FACE: (0.0, math.pi / 2.0),
    LEFT_SIDE: (-math.pi / 2.0, 0.0),
    RIGHT_SIDE: (math.pi / 2.0, 0.0),
}
"""Roll and pitch of the base."""
SPREAD_RAD = 0.3
"""Greatest deviation of roll and pitch from these."""
SHARE = 0.3
"""Share of its range within which each joint is, around zero."""
STAYS_S = 2.0
"""How long the robot must then stand."""


@dataclass(frozen=True)
class Trial:
    """A lying posture, and the noise of the sensors."""

    number: int
    lies: str
    noise: float
    within_s: float
    hands: bool


def main() -> int:
    """Run, print a table, and return the exit status: 1 if it stands less often than asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--trials', type=in_range(int, 1), default=40)
    parser.add_argument('--first', type=in_range(int, 0), default=0, help='number of the first')
    parser.add_argument('--at-least', type=in_range(float, 0.0, 1.0), default=0.9, metavar='SHARE')
    parser.add_argument('--within', type=in_range(float, 1.0), default=15.0, help='in s')
    parser.add_argument(
        '--noise', type=in_range(float, 0.0), default=1.0, help="factor of the sensors' noise"
    )
    parser.add_argument('--hands', action='store_true', help='give the robot hands')
    parser.add_argument('--processes', type=in_range(int, 1), default=1)
    options = parser.parse_args()
    names = list(LYING)
    trials = [
        Trial(number, names[number % 4], options.noise, options.within, options.hands)
        for number in range(options.first, options.first + options.trials)
    ]
    times: dict[str, list[float]] = {name: [] for name in names}
    with multiprocessing.Pool(options.processes) as pool:
        for trial, time_s in zip(trials, pool.imap(time_to_stand_s, trials)):
            times[trial.lies].append(time_s)
            if math.isinf(time_s):
                print(f'Trial {trial.number}, on the {trial.lies}: it does not stand.', flush=True)
    print('\n| lies on | stands | mean | longest |\n|---|---|---|---|')
    for name, all_s in times.items():
        print(_row(name, all_s))
    stood = sum(math.isfinite(each) for all_s in times.values() for each in all_s)
    print(f'\n{stood} of {len(trials)} stood within {options.within:g} s')
    return int(stood < options.at_least * len(trials))


def time_to_stand_s(trial: Trial) -> float:
    """
    Let a robot get up; return how long that took, from the end of the fall on.

    Parameters
    ----------
    trial
        How it lies.

    Returns
    -------
    float
        The time in s; infinite if it does not stand in time, or falls again.

    """
    random = np.random.default_rng(trial.number)
    settings = BackendSettings(noise=REALISTIC.scaled(trial.noise), seed=trial.number)
    posture = random_posture(random, trial.lies, trial.hands)
    robot = LockstepRobot(settings, hands=trial.hands, keyframes={'lying': posture})
    robot.reset('lying')
    walker, fall = robot.walking.walker, robot.walking.walker.parameters.fall
    begin_s = robot.backend.time_s + fall.collapse_s + fall.lie_s
    robot.tick()
    while walker.has_fallen and robot.backend.time_s < begin_s + trial.within_s:
        robot.tick()
    time_s = robot.backend.time_s - begin_s
    for _ in range(round(STAYS_S / robot.backend.period_s)):
        if walker.has_fallen:
            return math.inf
        robot.tick()
    return time_s


def random_posture(random: np.random.Generator, lies: str, hands: bool) -> Keyframe:
    """
    Draw a lying posture.

    Parameters
    ----------
    random
        Source of random numbers.
    lies
        A key of `LYING`.
    hands
        Whether the robot has hands.

    """
    joints_rad = {
        name: random.uniform(SHARE * drive.lower, SHARE * drive.upper)
        for name, drive in load_drives(hands=hands).items()
    }
    roll_rad, pitch_rad = np.add(LYING[lies], random.uniform(-SPREAD_RAD, SPREAD_RAD, 2)).tolist()
    return Keyframe(joints_rad, roll_rad, pitch_rad)


def _row(name: str, times_s: list[float]) -> str:
    """Format the row of a way to lie."""
    stood = [time_s for time_s in times_s if math.isfinite(time_s)]
    mean = f'{sum(stood) / len(stood):.1f} s' if stood else '-'
    longest = f'{max(stood):.1f} s' if stood else '-'
    return f'| {name} | {len(stood)} of {len(times_s)} | {mean} | {longest} |'


if __name__ == '__main__':
    sys.exit(main())
