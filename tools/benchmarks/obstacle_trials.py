# SPDX-License-Identifier: Apache-2.0
"""Tell the humanoid to walk into obstacles: `make trials ARGS='--trials 40'`.

Walls, edges of tables, corners of shelves and loose objects, on all four sides, at 0.1 to
0.5 m/s; the command goes on for 1 to 10 s after the first touch. There is no ROS: controller and
physics run in lockstep, as fast as possible, and sensors are noisy. The status is 1 if more than
2 % fall.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import multiprocessing
import sys
import time

from arguments import in_range
from obstacle_run import KINDS, run_trial, SIDES, Trial, TrialResult

FALLS_ALLOWED = 0.02


def main() -> int:
    """Run, print a table, and return the exit status: 1 if too many fell."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--trials', type=in_range(int, 1), default=200)
    parser.add_argument(
        '--first', type=in_range(int, 0), default=0, help='number of the first trial'
    )
    parser.add_argument('--processes', type=in_range(int, 1), default=2)
    parser.add_argument('--all', action='store_true', help='also list the trials without a fall')
    options = parser.parse_args()
    trials = [Trial.drawn(options.first + number) for number in range(options.trials)]
    begin_s, results = time.monotonic(), list[TrialResult]()
    print('| trial | obstacle | command | insisted | blocked after | result |')
    print('|---|---|---|---|---|---|')
    with multiprocessing.Pool(options.processes) as pool:
        for result in pool.imap(run_trial, trials):
            results.append(result)
            if options.all or result.fell:
                print(row(result), flush=True)
    print(summary(results, time.monotonic() - begin_s))
    falls = sum(result.fell for result in results)
    return int(falls > FALLS_ALLOWED * len(results))


def row(result: TrialResult) -> str:
    """
    Format the table row of a trial.

    Parameters
    ----------
    result
        The result of the trial.

    """
    trial, touched_s = result.trial, result.touched_s
    blocked = '-'
    if result.reported_s is not None and touched_s is not None:
        blocked = f'{result.reported_s - touched_s:.1f} s'
    fall = 'stood'
    if result.fell_s is not None:
        since = '' if touched_s is None else f', {result.fell_s - touched_s:.1f} s after the touch'
        fall = f'fell at {result.fell_s:.1f} s{since}'
    return (
        f'| {trial.number} | {trial.kind} {trial.side} | {trial.speed_m_s:.2f} m/s '
        f'| {trial.insistence_s:.1f} s | {blocked} '
        f'| {fall} (leaned {result.leaned_rad:.2f} rad) |'
    )


def summary(results: Sequence[TrialResult], wall_s: float) -> str:
    """
    Format the falls by kind and side of the obstacle, and in total.

    Parameters
    ----------
    results
        The results of all trials.
    wall_s
        The total wall time.

    """
    lines = ['', '| falls | ' + ' | '.join(SIDES) + ' |', '|---' * (len(SIDES) + 1) + '|']
    for kind in KINDS:
        cells = [
            _count([r for r in results if (r.trial.kind, r.trial.side) == (kind, side)])
            for side in SIDES
        ]
        lines.append(f'| {kind} | ' + ' | '.join(cells) + ' |')
    blocked = sum(result.reported_s is not None for result in results)
    touched = sum(result.touched_s is not None for result in results)
    falls = sum(result.fell for result in results)
    lines.append(
        f'\n{falls} of {len(results)} fell; {touched} touched, {blocked} said that the way is '
        f'blocked; {wall_s:.0f} s'
    )
    return '\n'.join(lines)


def _count(results: Sequence[TrialResult]) -> str:
    return f'{sum(result.fell for result in results)} of {len(results)}'


if __name__ == '__main__':
    sys.exit(main())
