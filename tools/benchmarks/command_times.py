# SPDX-License-Identifier: Apache-2.0
"""Measure what the commands cost: CPU and wall time of the whole process, median of several runs.

`make bench ARGS='--runs 10'`. The first row is a Python that does nothing, on this machine and
now: compare the others with it, for machines differ and are busy. With `--against FOLDER` each
command also runs in the built workspace there, in turn, and the ratio is printed.
"""

from __future__ import annotations

import argparse
import shlex
import sys

from arguments import built_workspace
from comparing import print_comparison
from measuring import COST_HEADER, median_cost

COMMANDS = (
    'python3 -c pass',
    'ros2 --help',
    'ros2 pkg list',
    'ros2 pkg prefix humanoid_bringup',
    'ros2 pkg executables',
    'ros2 run tracetools status',
    'ros2 launch humanoid_bringup bringup.launch.py --show-args',
    'ros2 topic list',
    'ros2 node list',
    "ros2 topic pub --once -w 0 /chatter std_msgs/msg/String '{data: hi}'",
)


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=5, help='counted runs of each command')
    parser.add_argument(
        '--against', type=built_workspace, metavar='FOLDER', help='another built workspace'
    )
    args = parser.parse_args()
    if args.against:
        print_comparison([(command, command) for command in COMMANDS], args.against, args.runs)
        return
    runs = args.runs
    print(f'Python {sys.version.split()[0]}, median of {runs} runs after one that is not counted')
    print(f'{COST_HEADER}  command')
    for command in COMMANDS:
        print(f'{median_cost(shlex.split(command), runs)}  {command}', flush=True)


if __name__ == '__main__':
    main()
