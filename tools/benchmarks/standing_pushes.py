# SPDX-License-Identifier: Apache-2.0
"""
Push the humanoid while it stands, in each mode of its controllers that can stand.

The table says how many of the pushes of 0.1 s it survives, in eight directions, with realistic
noise of the sensors: with held joints, with a policy, and with the walk, which also steps. There
is no ROS: controllers and physics run in lockstep, as fast as possible.
"""

from __future__ import annotations

import argparse
import cmath
from dataclasses import dataclass
import math
import multiprocessing

from arguments import in_range
from humanoid_common.errors import UserError
from humanoid_control.hosting.policies import policy_path
from humanoid_control.policy import Policy
from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.testing.lockstep_robot import LockstepRobot

MODES = ('hold', 'policy', 'walking')
DIRECTIONS = 8
SETTLE_S, WATCH_S = 1.5, 4.0


@dataclass(frozen=True)
class Trial:
    """A push of a robot that stands."""

    mode: str
    impulse_ns: float
    direction: int
    """0 is forward, 2 is to the left."""
    noise: float
    policy: str

    @property
    def seed(self) -> int:
        """Return the seed of the noise, which is the same for each mode."""
        return round(10 * self.impulse_ns) * DIRECTIONS + self.direction


def main() -> None:
    """Run all trials, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    parser.add_argument(
        '--impulses',
        type=in_range(float, 0.0),
        nargs='+',
        default=[8.0, 12.0, 16.0, 20.0, 24.0],
        help='in N s',
    )
    parser.add_argument('--modes', nargs='+', choices=MODES, default=list(MODES))
    parser.add_argument('--policy', default='stand', help='an installed one, or its YAML file')
    parser.add_argument(
        '--noise', type=in_range(float, 0.0), default=1.0, help="factor of the sensors' noise"
    )
    parser.add_argument('--processes', type=in_range(int, 1), default=1)
    options = parser.parse_args()
    try:
        if 'policy' in options.modes:
            use(options.policy, LockstepRobot(BackendSettings()))
    except UserError as error:
        parser.error(str(error))
    trials = [
        Trial(mode, impulse, direction, options.noise, options.policy)
        for mode in options.modes
        for impulse in options.impulses
        for direction in range(DIRECTIONS)
    ]
    print('| mode | ' + ' | '.join(f'{each:g} N s' for each in options.impulses) + ' |')
    print('|---' * (1 + len(options.impulses)) + '|')
    with multiprocessing.Pool(options.processes) as pool:
        stood = pool.imap(stands_after, trials)
        for mode in options.modes:
            counts = [sum(next(stood) for _ in range(DIRECTIONS)) for _ in options.impulses]
            cells = ' | '.join(f'{count} of {DIRECTIONS}' for count in counts)
            print(f'| {mode} | {cells} |', flush=True)


def stands_after(trial: Trial) -> bool:
    """
    Push a robot that stands; return whether it still stands `WATCH_S` later.

    Parameters
    ----------
    trial
        The push, and the mode of the controllers.

    """
    settings = BackendSettings(noise=REALISTIC.scaled(trial.noise), seed=trial.seed)
    robot = LockstepRobot(settings)
    walking = robot.walking
    if trial.mode == 'policy':
        use(trial.policy, robot)
    robot.wait(0.5)
    walking.control.manager.switch(trial.mode)
    robot.wait(SETTLE_S)
    robot.push(cmath.rect(1.0, math.tau * trial.direction / DIRECTIONS), trial.impulse_ns)
    return robot.wait(WATCH_S)


def use(policy: str, robot: LockstepRobot) -> None:
    """
    Load a policy for the mode `policy` of a robot.

    Parameters
    ----------
    policy
        An installed one, or its YAML file.
    robot
        The robot.

    Raises
    ------
    UserError
        It cannot be run.

    """
    walking = robot.walking
    walking.use_policy(Policy.load(policy_path(policy), walking.policy.robot))


if __name__ == '__main__':
    main()
