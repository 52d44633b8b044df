# SPDX-License-Identifier: Apache-2.0
"""Let the humanoid walk for a long time under bad conditions: `make soak ARGS='--runs 5'`.

Each run has a friction, a mass, a latency and sensor noise of its own, and random commands with a
push in each. There is no ROS: controller and physics run in lockstep, as fast as possible. The
table is that of docs/explanation/performance.md. The status is 1 if more than one in twenty falls.
"""

from __future__ import annotations

import argparse
import sys
import time

from arguments import in_range
from soak_run import Conditions, SoakResult, SoakRun

FALLS_ALLOWED = 1 / 20


def main() -> int:
    """Run, print a table, and return the exit status: 1 if too many fell."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=20)
    parser.add_argument('--seconds', type=float, default=60.0, help='length of a run')
    parser.add_argument('--first-seed', type=in_range(int, 0), default=0)
    parser.add_argument('--push', type=float, default=8.0, help='impulse of each push in N s')
    parser.add_argument(
        '--drop-outs',
        type=in_range(float, 0.0, 1.0),
        default=0.0,
        help='chance of a tick that control stalls for 1 to 10 ticks',
    )
    parser.add_argument('--hands', action='store_true', help='give the robot hands')
    parser.add_argument(
        '--load',
        type=in_range(float, 0.0, 5.0),
        default=0.0,
        metavar='KG',
        help='what its left hand carries',
    )
    options = parser.parse_args()
    if options.load and not options.hands:
        parser.error('--load needs --hands: nothing carries without')
    if options.runs < 1 or options.seconds <= 0.0:
        parser.error('--runs and --seconds must be above zero: nothing else shows anything')
    print('| run | friction | mass | latency | walked | result |\n|---|---|---|---|---|---|')
    begin_s, results = time.process_time(), []
    for seed in range(options.first_seed, options.first_seed + options.runs):
        run = SoakRun(
            Conditions.drawn(seed), options.push, options.drop_outs, options.hands, options.load
        )
        results.append(run.run(options.seconds))
        print(row(results[-1]), flush=True)
    print(summary(results, time.process_time() - begin_s))
    falls = sum(result.fell for result in results)
    return int(falls > FALLS_ALLOWED * len(results))


def row(result: SoakResult) -> str:
    """
    Format the table row of a run.

    Parameters
    ----------
    result
        The result of the run.

    """
    conditions = result.conditions
    return (
        f'| {conditions.seed} | {conditions.friction:.2f} | {conditions.mass_factor - 1:+.0%} '
        f'| {conditions.latency_periods * 10} ms | {result.distance_m:.1f} m | {ending(result)} |'
    )


def ending(result: SoakResult) -> str:
    """
    Describe how a run ended.

    Parameters
    ----------
    result
        The result of the run.

    """
    if not result.fell:
        return 'stood'
    command, push_ns = result.last.command, result.last.impulse_ns
    return (
        f'fell at {result.survived_s:.1f} s ({result.phase}), commanded {command.forward_m_s:.2f} '
        f'{command.left_m_s:.2f} {command.turn_rad_s:.2f}, pushed {push_ns.real:.0f} '
        f'{push_ns.imag:.0f} N s after {result.last.push_after_s:.1f} s'
    )


def summary(results: list[SoakResult], cpu_s: float) -> str:
    """
    Format the summary of all runs.

    Parameters
    ----------
    results
        The results of all runs.
    cpu_s
        The total CPU time.

    """
    stood = sum(not result.fell for result in results)
    simulated_s = sum(result.survived_s for result in results)
    return (
        f'\n{stood} of {len(results)} stood; {simulated_s:.0f} s in {cpu_s:.0f} s of CPU, '
        f'{sum(result.distance_m for result in results):.0f} m; the way was taken for blocked '
        f'{sum(result.alarms for result in results)} times'
    )


if __name__ == '__main__':
    sys.exit(main())
