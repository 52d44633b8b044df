# SPDX-License-Identifier: Apache-2.0
"""Measure what a launch costs: to start processes, to end them, to show arguments, to import.

`make bench ARGS='--runs 10'`. Times are medians. The first row is a Python that does nothing,
on this machine and now: compare the others with it, for machines differ and are busy. With
`--against FOLDER` whole launches also run in the built workspace there, in turn, and the ratio is
printed.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
import shlex
import signal
import subprocess
import sys
import tempfile
import time

from arguments import built_workspace
from comparing import print_comparison
from measuring import COST_HEADER, median_cost, median_of

COUNTS = (1, 10, 100)
SHOW_ARGUMENTS = 'ros2 launch humanoid_bringup bringup.launch.py --show-args'
STARTED = b'process started with pid'
LAUNCH_FILE = """
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [Node(executable={program!r}, arguments=[{argument!r}], parameters=[{{'number': number}}])
         for number in range({count})]
    )
"""
MODULES = (
    'import launch',
    'from launch import LaunchService',
    'from launch_ros.actions import Node',
    'from launch_xml.launch_description_sources import XMLLaunchDescriptionSource',
    'from launch_yaml.launch_description_sources import YAMLLaunchDescriptionSource',
    'import rclpy',
)


def main() -> None:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=5, help='counted runs of each row')
    parser.add_argument(
        '--against', type=built_workspace, metavar='FOLDER', help='another built workspace'
    )
    args = parser.parse_args()
    if args.against:
        with tempfile.TemporaryDirectory() as folder:
            print_comparison(whole_launches(Path(folder)), args.against, args.runs)
        return
    runs = args.runs
    print(f'Python {sys.version.split()[0]}, median of {runs} runs after one that is not counted')
    with tempfile.TemporaryDirectory() as folder:
        print_whole_launches(Path(folder), runs)
        print_start_and_end(Path(folder), runs)
    print_imports(runs)


def whole_launches(folder: Path) -> Iterator[tuple[str, str]]:
    """
    List commands that end on their own.

    Parameters
    ----------
    folder
        The folder of the launch files.

    Yields
    ------
    str, str
        The command as for a shell, and its name in a table.

    """
    for command in ('python3 -c pass', SHOW_ARGUMENTS):
        yield command, command
    for count in COUNTS:
        file = launch_file(folder, count, '/bin/true', '')
        yield shlex.join(['ros2', 'launch', file]), f'ros2 launch of {count} x /bin/true'


def print_whole_launches(folder: Path, runs: int) -> None:
    """
    Print the cost of commands from their start to their end.

    Parameters
    ----------
    folder
        The folder of the launch files.
    runs
        The number of counted runs of each command.

    """
    print(f'\n{COST_HEADER}  command')
    for command, name in whole_launches(folder):
        print(f'{median_cost(shlex.split(command), runs)}  {name}', flush=True)


def print_start_and_end(folder: Path, runs: int) -> None:
    """
    Print how long it takes to start processes, and to end them.

    Parameters
    ----------
    folder
        The folder of the launch files.
    runs
        The number of counted runs for each number in the table.

    """
    print(f'\n{"start s":>7} {"end s":>7}  processes (command to last start, SIGINT to last end)')
    for count in COUNTS:
        file = launch_file(folder, count, '/bin/sleep', '60')
        start_s = median_of(lambda file=file, count=count: start_and_end(file, count)[0], runs)
        end_s = median_of(lambda file=file, count=count: start_and_end(file, count)[1], runs)
        print(f'{start_s:7.3f} {end_s:7.3f}  {count} x /bin/sleep', flush=True)


def print_imports(runs: int) -> None:
    """
    Print the duration of imports, without the start of Python itself.

    Parameters
    ----------
    runs
        The number of counted runs of each import.

    """
    print(f'\n{"ms":>7}  import (python3 -X importtime)')
    for statement in MODULES:
        took_ms = median_of(lambda statement=statement: import_ms(statement), runs)
        print(f'{took_ms:7.1f}  {statement}', flush=True)


def launch_file(folder: Path, count: int, program: str, argument: str) -> str:
    """
    Write a launch file with several identical processes and return its path.

    Parameters
    ----------
    folder
        The folder of the file.
    count
        The number of processes.
    program, argument
        The program of each process, and its argument, which may be empty.

    """
    path = folder / f'{count}_{Path(program).name}.launch.py'
    path.write_text(LAUNCH_FILE.format(program=program, argument=argument, count=count))
    return str(path)


def start_and_end(file: str, count: int) -> tuple[float, float]:
    """
    Launch processes that do not end, and interrupt the launch once all have started.

    Parameters
    ----------
    file
        The launch file.
    count
        The number of processes that it starts.

    Returns
    -------
    float, float
        The seconds until the last process has started, and from SIGINT to the end.

    """
    begin_s = time.monotonic()
    with running(['ros2', 'launch', file]) as launch:
        assert launch.stdout is not None
        started = 0
        while started < count:
            started += STARTED in next(launch.stdout)
        start_s = time.monotonic() - begin_s
        begin_s = time.monotonic()
        launch.send_signal(signal.SIGINT)
        launch.communicate()
        return start_s, time.monotonic() - begin_s


@contextmanager
def running(command: list[str]) -> Iterator[subprocess.Popen[bytes]]:
    """
    Run a command with its output in a pipe during a `with` block, then kill it.

    Parameters
    ----------
    command
        The program and its arguments.

    Yields
    ------
    Popen
        The process.

    """
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        try:
            yield process
        finally:
            process.kill()


def import_ms(statement: str) -> float:
    """
    Measure the execution time of the modules that a statement imports.

    Parameters
    ----------
    statement
        An import statement.

    Returns
    -------
    float
        Milliseconds, without the modules that Python imports at its own start.

    """
    command = [sys.executable, '-X', 'importtime', '-c', statement]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stderr.splitlines()
    modules = [line.split('|') for line in lines if line.startswith('import time:')][1:]
    site = next(row for row, fields in enumerate(modules) if fields[2].strip() == 'site') + 1
    return sum(int(fields[0].partition(':')[2]) for fields in modules[site:]) / 1000


if __name__ == '__main__':
    main()
