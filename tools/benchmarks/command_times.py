# SPDX-License-Identifier: Apache-2.0
"""Measure what the commands cost: CPU and wall time of the whole process, median of several runs.

`make bench ARGS='--runs 10'`. The first row is a Python that does nothing, on this machine and
now: compare the others with it, for machines differ and are busy.
"""

from __future__ import annotations

import argparse
import shlex
import sys

from measuring import COST_HEADER, median_cost

COMMANDS = (
    'python3 -c pass',
    'ros2 --help',
    'ros2 pkg list',
    'ros2 pkg prefix humanoid_bringup',
    'ros2 launch humanoid_bringup bringup.launch.py --show-args',
    'ros2 topic list',
    'ros2 node list',
)


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=5, help='counted runs of each command')
    runs = parser.parse_args().runs
    print(f'Python {sys.version.split()[0]}, median of {runs} runs after one that is not counted')
    print(f'{COST_HEADER}  command')
    for command in COMMANDS:
        print(f'{median_cost(shlex.split(command), runs)}  {command}', flush=True)


if __name__ == '__main__':
    main()
