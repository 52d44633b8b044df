# SPDX-License-Identifier: Apache-2.0
"""Push the humanoid to the side while it walks, in every phase of its step.

The table says which pushes it stands, for each foot that carries it and each share of the step at
which the push of 0.1 s begins. Its legs collide with each other. There is no ROS: controller and
physics run in lockstep, as fast as possible. The status is 1 if it falls.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import multiprocessing
import sys

from arguments import in_range
from humanoid_control.walking.planar import NAMES, SIDES
from push_trial import DIRECTIONS, PushTrial, stands_after


def main() -> int:
    """Run, print a table, and return the exit status: 1 if the robot fell."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        '--impulses',
        type=in_range(float, 0.0),
        nargs='+',
        default=[20.0, 25.0, 30.0],
        help='in N s',
    )
    parser.add_argument('--phases', type=in_range(int, 1), default=6, help='how many in a step')
    parser.add_argument('--speed', type=in_range(float, 0.05, 1.0), default=0.3, help='in m/s')
    parser.add_argument('--directions', nargs='+', choices=DIRECTIONS, default=list(DIRECTIONS))
    parser.add_argument(
        '--noise', type=in_range(float, 0.0), default=0.0, help="factor of the sensors' noise"
    )
    parser.add_argument('--seed', type=in_range(int, 0), default=0)
    parser.add_argument('--hands', action='store_true', help='give the robot hands')
    parser.add_argument('--processes', type=in_range(int, 1), default=1)
    options = parser.parse_args()
    phases = [number / options.phases for number in range(options.phases)]
    trials = [
        PushTrial(
            impulse,
            direction,
            side,
            phase,
            options.speed,
            options.noise,
            options.seed,
            options.hands,
        )
        for impulse in options.impulses
        for direction in options.directions
        for side in SIDES
        for phase in phases
    ]
    print('| push | on the foot | ' + ' | '.join(f'{phase:.0%}' for phase in phases) + ' |')
    print('|---' * (len(phases) + 2) + '|')
    falls, row = 0, list[bool]()
    with multiprocessing.Pool(options.processes) as pool:
        for trial, stands in zip(trials, pool.imap(stands_after, trials)):
            row.append(stands)
            falls += not stands
            if len(row) == len(phases):
                print(_row(trial, row), flush=True)
                row.clear()
    print(f'\n{falls} of {len(trials)} fell')
    return int(falls > 0)


def _row(trial: PushTrial, stood: Sequence[bool]) -> str:
    """Format the row of all phases of a push."""
    cells = ' | '.join('stood' if each else 'fell' for each in stood)
    return f'| {trial.impulse_ns:.0f} N s {trial.direction} | {NAMES[trial.support]} | {cells} |'


if __name__ == '__main__':
    sys.exit(main())
