# SPDX-License-Identifier: Apache-2.0
"""Measure what the parts of navigation cost, and the whole of it while a robot walks.

`make bench ARGS='--runs 5'`, or this file with `--stack`. The times are CPU time of one thread.
The first table is of single requests without ROS; the second one is read off while all servers
guide a robot of the loopback simulator through the apartment, in this process. `--stack` starts
navigation as users do and reads what share of a core its process takes, standing and walking.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from functools import partial
import time

from arguments import in_range
from measuring import median_of
from navigation_parts import (
    control_step,
    house,
    localization,
    mapping,
    PLANNED_CELLS,
    planning,
    smoothing,
)
from navigation_stack import stack_shares
from navigation_walk import walk_costs
import rclpy

CONTROLLERS = {
    'MPPI, as configured': ('MPPI', 3.0),
    'MPPI, 1000 samples of 56 steps': ('MPPI, large', None),
    'RPP': ('RPP', 3.0),
    'DWB, 9 x 9 x 15 velocities': ('DWB', 3.0),
}
LIMIT_OF_STACK = 0.35


def main() -> None:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=in_range(int, 1), default=5, help='runs of each row')
    parser.add_argument('--stack', action='store_true', help='measure the whole, launched')
    parser.add_argument(
        '--seconds', type=in_range(float, 1.0), default=20.0, help='how long the robot walks'
    )
    given = parser.parse_args()
    if given.stack:
        print(f'{"CPU %":>7} {"limit":>7}  the process of navigation')
        for what, share in stack_shares(given.seconds):
            print(f'{share:7.1%} {LIMIT_OF_STACK:7.0%}  {what}', flush=True)
        return
    rclpy.init()
    print(f'{"CPU ms":>7} {"limit":>7}  what, median of {given.runs} runs')
    for what, limit_ms, action in rows():
        print_row(median_of(partial(cost_ms, action), given.runs), limit_ms, what)
    rclpy.shutdown()
    print(f'\n{"CPU ms":>7} {"times":>7}  what, median while the robot walks')
    for what, cost, times in walk_costs(given.seconds):
        print(f'{cost:7.2f} {times:7d}  {what}', flush=True)


def rows() -> Iterator[tuple[str, float | None, Callable[[], object]]]:
    """Return the names, limits and actions of the first table."""
    for size, limit_ms in PLANNED_CELLS.items():
        fresh, again, changed = planning(house(size))
        yield f'plan {size} x {size} cells, a fresh goal', limit_ms, fresh
        yield '  to the same goal', limit_ms, again
        yield '  to the same goal, other costs', limit_ms, changed
    for name, smooth in smoothing().items():
        yield f'{name}, a path of 20 m', None, smooth
    for what, (kind, limit_ms) in CONTROLLERS.items():
        yield f'controller step: {what}', limit_ms, control_step(kind)
    for particles in (500, 2000):
        yield f'AMCL update, {particles} particles, 60 beams', None, localization(particles)
    yield 'SLAM keyframe, 360 beams', None, mapping()


def print_row(cost: float, limit_ms: float | None, what: str) -> None:
    """
    Print one row of the first table.

    Parameters
    ----------
    cost
        The CPU time in ms.
    limit_ms
        The limit of the time, if there is one.
    what
        The name of the row.

    """
    limit = '' if limit_ms is None else f'{limit_ms:.0f}'
    print(f'{cost:7.2f} {limit:>7}  {what}', flush=True)


def cost_ms(action: Callable[[], object]) -> float:
    """
    Measure the CPU time in ms of an action in this thread.

    Parameters
    ----------
    action
        The action to measure.

    """
    begin_s = time.thread_time()
    action()
    return (time.thread_time() - begin_s) * 1e3


if __name__ == '__main__':
    main()
