# SPDX-License-Identifier: Apache-2.0
"""Measure Python nodes that are forked from a template against nodes that are executed.

For each way: the time from the command to the first message of the last node, the CPU time until
then of all processes, and the memory of each node (PSS, the share of common pages counted). The
nodes belong to a package that is made for the measurement. Run it in the environment of the
workspace: `tools/in_environment python3 tools/benchmarks/prefork_times.py --nodes 20`.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
import os
import signal
from statistics import mean, median
import subprocess
import sys
import tempfile
import time

PACKAGE = 'prefork_times_talkers'
VERSION = f'{sys.version_info.major}.{sys.version_info.minor}'
SITE_PACKAGES = f'lib/python{VERSION}/site-packages'
FILES = {
    f'share/ament_index/resource_index/packages/{PACKAGE}': '',
    f'share/{PACKAGE}/package.xml': f'<package><name>{PACKAGE}</name></package>',
    f'{SITE_PACKAGES}/{PACKAGE}/__init__.py': '',
    f'{SITE_PACKAGES}/{PACKAGE}/talker.py': """
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import Temperature


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.publisher = self.create_publisher(Temperature, 'temperature', 10)
        self.timer = self.create_timer(0.001, self.publish)

    def publish(self):
        self.publisher.publish(Temperature(temperature=20.0))
        self.timer.cancel()
        print('published', flush=True)


def main():
    rclpy.init()
    try:
        rclpy.spin(Talker())
    except KeyboardInterrupt:
        pass
""",
    f'{SITE_PACKAGES}/{PACKAGE}-0.0.0.dist-info/METADATA': f'Name: {PACKAGE}\nVersion: 0.0.0\n',
    f'{SITE_PACKAGES}/{PACKAGE}-0.0.0.dist-info/entry_points.txt': f"""
[console_scripts]
talker = {PACKAGE}.talker:main
""",
    f'lib/{PACKAGE}/talker': f"""#!{sys.executable}
import sys
from importlib.metadata import distribution


def load_entry_point(name, group, entry):
    points = distribution(name).entry_points
    return next(p for p in points if p.group == group and p.name == entry).load()


if __name__ == '__main__':
    sys.exit(load_entry_point('{PACKAGE}', 'console_scripts', 'talker')())
""",
    'talkers.launch.py': f"""
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='{PACKAGE}', executable='talker', name=f'talker_{{i}}', output='screen')
        for i in range(%d)
    ])
""",
}


@dataclass(frozen=True)
class Cost:
    """The time until all nodes have published, and their memory then."""

    wall_s: float
    cpu_s: float
    pss_mb: float


def write_package(prefix: str, nodes: int) -> None:
    """
    Install the package of the talkers, and write its launch file.

    Parameters
    ----------
    prefix
        The folder to install into.
    nodes
        The number of nodes that the launch file starts.

    """
    for path, text in FILES.items():
        path = os.path.join(prefix, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'w') as file:
            file.write(text % nodes if path.endswith('.launch.py') else text)
    os.chmod(os.path.join(prefix, 'lib', PACKAGE, 'talker'), 0o755)  # noqa: S103


def environment_with(prefix: str) -> dict[str, str]:
    """
    Return the environment variables with which the package is found.

    Parameters
    ----------
    prefix
        The folder that it is installed in.

    """
    added = {'AMENT_PREFIX_PATH': prefix, 'PYTHONPATH': os.path.join(prefix, SITE_PACKAGES)}
    joined = {
        name: os.pathsep.join(filter(None, (path, os.environ.get(name, ''))))
        for name, path in added.items()
    }
    return {**os.environ, **joined}


def measure(prefix: str, nodes: int, options: list[str]) -> Cost:
    """
    Launch the nodes, wait until all have published, measure their cost and end them.

    Parameters
    ----------
    prefix
        The folder that the package is installed in.
    nodes
        The number of nodes that the launch file starts.
    options
        Further options of `ros2 launch`.

    Returns
    -------
    Cost
        The times are those of the launch and all nodes; the memory is the mean of a node.

    """
    command = ['ros2', 'launch', *options, os.path.join(prefix, 'talkers.launch.py')]
    begin_s = time.monotonic()
    with subprocess.Popen(
        command, env=environment_with(prefix), stdout=subprocess.PIPE, text=True
    ) as launch:
        assert launch.stdout is not None
        pids, published = [], 0
        for line in launch.stdout:
            if 'process started with pid' in line:
                pids.append(int(line.rpartition('[')[2].rstrip(']\n')))
            published += 'published' in line
            if published == nodes:
                break
        wall_s = time.monotonic() - begin_s
        cpu_s = sum(cpu_times([launch.pid, *pids]))
        pss_mb = mean(pss_of(pid) for pid in pids)
        launch.send_signal(signal.SIGINT)
        launch.communicate()
    return Cost(wall_s, cpu_s, pss_mb)


def cpu_times(pids: list[int]) -> Iterator[float]:
    """
    Read the CPU time used by each process and its terminated children.

    Parameters
    ----------
    pids
        The process ids.

    Yields
    ------
    float
        User and system time in s, one for each process.

    """
    for pid in pids:
        with open(f'/proc/{pid}/stat') as file:
            fields = file.read().rpartition(')')[2].split()
        yield sum(map(int, fields[11:15])) / os.sysconf('SC_CLK_TCK')


def pss_of(pid: int) -> float:
    """
    Read the proportional set size (PSS) of a process, in thousands of kB.

    Parameters
    ----------
    pid
        The process id.

    """
    with open(f'/proc/{pid}/smaps_rollup') as file:
        line = next(line for line in file if line.startswith('Pss:'))
    return int(line.split()[1]) / 1000


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--nodes', type=int, default=20)
    parser.add_argument('--runs', type=int, default=3, help='runs of each way, in turn')
    args = parser.parse_args()
    ways: dict[str, list[str]] = {'executed': ['--no-prefork'], 'forked': []}
    with tempfile.TemporaryDirectory() as prefix:
        write_package(prefix, args.nodes)
        costs: dict[str, list[Cost]] = {way: [] for way in ways}
        for _ in range(args.runs):
            for way, options in ways.items():
                costs[way].append(measure(prefix, args.nodes, options))
    print(f'{args.nodes} nodes, median of {args.runs} runs')
    print(f'{"":10} {"wall s":>7} {"CPU s":>7} {"PSS MB":>7}')
    rows = {
        way: [median(getattr(c, name) for c in runs) for name in ('wall_s', 'cpu_s', 'pss_mb')]
        for way, runs in costs.items()
    }
    rows['ratio'] = [f / e for f, e in zip(rows['forked'], rows['executed'])]
    for way, numbers in rows.items():
        print(f'{way:10} ' + ' '.join(f'{number:7.2f}' for number in numbers))


if __name__ == '__main__':
    main()
