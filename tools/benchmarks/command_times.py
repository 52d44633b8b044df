# SPDX-License-Identifier: Apache-2.0
"""Measure what the commands cost: CPU and wall time of the whole process, median of several runs.

`make bench ARGS='--runs 10'`. The first row is a Python that does nothing, on this machine and
now: compare the others with it, for machines differ and are busy.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
import os
import shlex
from statistics import median
import subprocess
import sys
import tempfile
import time

LAUNCH_FILE = """
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(executable='/bin/true') for _ in range({count})])
"""


@dataclass(frozen=True)
class Cost:
    """What one run took, its children included."""

    cpu_s: float
    wall_s: float
    memory_mb: float


def measure(command: list[str]) -> Cost:
    """Run a command once, its output thrown away."""
    begin_s = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, _, usage = os.wait4(process.pid, 0)
    wall_s = time.monotonic() - begin_s
    return Cost(usage.ru_utime + usage.ru_stime, wall_s, usage.ru_maxrss / 1000)


def commands(folder: str) -> list[list[str]]:
    """Return the commands to measure; their launch files go to a folder."""
    files = []
    for count in (1, 100):
        files.append(os.path.join(folder, f'true_{count}.launch.py'))
        with open(files[-1], 'w') as file:
            file.write(LAUNCH_FILE.format(count=count))
    lines = [
        'python3 -c pass',
        'ros2 --help',
        'ros2 pkg list',
        'ros2 pkg prefix humanoid_bringup',
        'ros2 launch humanoid_bringup bringup.launch.py --show-args',
        'ros2 topic list',
    ]
    return [shlex.split(line) for line in lines] + [['ros2', 'launch', file] for file in files]


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=5, help='counted runs of each command')
    runs = parser.parse_args().runs
    print(f'Python {sys.version.split()[0]}, median of {runs} runs after one that is not counted')
    print(f'{"CPU s":>7} {"wall s":>7} {"MB":>6}  command')
    with tempfile.TemporaryDirectory() as folder:
        for command in commands(folder):
            costs = [measure(command) for _ in range(runs + 1)][1:]
            cpu_s, wall_s = median(c.cpu_s for c in costs), median(c.wall_s for c in costs)
            memory_mb = median(c.memory_mb for c in costs)
            text = shlex.join([os.path.basename(part) for part in command])
            print(f'{cpu_s:7.3f} {wall_s:7.3f} {memory_mb:6.1f}  {text}', flush=True)


if __name__ == '__main__':
    main()
