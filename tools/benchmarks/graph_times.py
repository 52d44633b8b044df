# SPDX-License-Identifier: Apache-2.0
"""Measure how long it takes to know all about running nodes, and whether all is known.

`make bench ARGS='--runs 50'`. A launch starts twenty nodes; then `ros2 topic list` and
`ros2 node list` run again and again, and a new node of rclpy waits until it has discovered them.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
import signal
from statistics import median
import subprocess
import sys
import tempfile
import time

NODES = 20
SETTLE_S = 3.0
START_TIMEOUT_S = 60.0
TOPICS = {f'/t{index}' for index in range(NODES)} | {'/parameter_events', '/rosout'}
NAMES = {f'/n{index}' for index in range(NODES)}
LAUNCH_FILE = f"""
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [Node(package='temperature_monitor', executable='temp_publisher', name=f'n{{index}}',
              remappings=[('temperature', f't{{index}}')])
         for index in range({NODES})]
    )
"""
RCLPY = f"""
import time, rclpy
rclpy.init()
begin_s = time.monotonic()
node = rclpy.create_node('_latecomer')
names = {{f'n{{index}}' for index in range({NODES})}}
while time.monotonic() - begin_s < 30 and not (
    names <= set(node.get_node_names())
    and all(node.count_publishers(f'/t{{index}}') for index in range({NODES}))
):
    time.sleep(0.01)
print(time.monotonic() - begin_s)
"""


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=10, help='runs of each row')
    runs = parser.parse_args().runs
    print(f'\n{NODES} nodes, {runs} runs')
    print(f'{"median s":>8} {"longest":>8} {"complete":>9}  what')
    with tempfile.TemporaryDirectory() as folder, running_nodes(Path(folder)):
        print_row('ros2 topic list', lambda: listing('topic', TOPICS), runs)
        print_row('ros2 node list', lambda: listing('node', NAMES), runs)
        print_row('a new node of rclpy knows all of them', latecomer, runs)


def print_row(what: str, measure: Callable[[], tuple[float, bool]], runs: int) -> None:
    """
    Measure repeatedly, and print one row of the table.

    Parameters
    ----------
    what
        The name of the row.
    measure
        Returns the time in s, and whether all nodes or topics were discovered.
    runs
        The number of measurements.

    """
    results = [measure() for _ in range(runs)]
    times_s = [wall_s for wall_s, _ in results]
    complete = f'{sum(is_complete for _, is_complete in results)}/{runs}'
    print(f'{median(times_s):8.3f} {max(times_s):8.3f} {complete:>9}  {what}', flush=True)


def listing(command: str, expected: set[str]) -> tuple[float, bool]:
    """
    Run `ros2 topic list` or `ros2 node list`.

    Parameters
    ----------
    command
        `topic` or `node`.
    expected
        The expected names.

    Returns
    -------
    float, bool
        The wall time in s, and whether it printed exactly these names.

    """
    begin_s = time.monotonic()
    result = subprocess.run(['ros2', command, 'list'], capture_output=True, text=True, check=True)
    return time.monotonic() - begin_s, set(result.stdout.split()) == expected


def latecomer() -> tuple[float, bool]:
    """Measure the time that a new rclpy node needs for discovery."""
    result = subprocess.run(
        [sys.executable, '-c', RCLPY], capture_output=True, text=True, check=True
    )
    return float(result.stdout), True


@contextmanager
def running_nodes(folder: Path) -> Iterator[None]:
    """
    Launch the nodes during a `with` block, which starts when all are up, after a minute at most.

    Parameters
    ----------
    folder
        The folder of the launch file.

    """
    file = folder / 'many.launch.py'
    file.write_text(LAUNCH_FILE)
    launch = subprocess.Popen(['ros2', 'launch', str(file)], stdout=subprocess.DEVNULL)
    try:
        end_s = time.monotonic() + START_TIMEOUT_S
        while not listing('node', NAMES)[1] and time.monotonic() < end_s:
            time.sleep(SETTLE_S)
        time.sleep(SETTLE_S)
        yield
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait()


if __name__ == '__main__':
    main()
