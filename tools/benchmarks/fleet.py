# SPDX-License-Identifier: Apache-2.0
"""
Measure what a fleet of mock robots costs, with and without a discovery server.

Each robot has a namespace of its own (robot1, robot2 ...) and the nodes of a bring-up with a mock
robot and no page: the robot itself, `sensor_processor` and `robot_state_publisher`. By default the
robots hold their joints, since ten that are ready to walk would need more than two cores
(`--mode walking`). With `multicast` and `server` each robot is on a machine of its own, and one
more machine has the server and whoever joins; with `localhost` all are on one machine. Measured
are the time until a new node knows all nodes and endpoints, how soon it hears each robot, what
passes over the network, and CPU and memory of all robots at rest. It needs root, in the
environment of the workspace: `tools/in_environment python3 tools/benchmarks/fleet.py --robots 10`.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
import json
import os
from pathlib import Path
import signal
from statistics import mean, median
import subprocess
import sys
from tempfile import TemporaryDirectory
import time

from arguments import in_range
from bringup_run import cpu_by_process, pss_mb
from machines import connected, Machines, running, Traffic
from measuring import endpoints_of

WAYS = ('multicast', 'server', 'localhost')
NODES = ('robot', 'robot_state_publisher', 'sensor_processor')
PORT = 11811
DOMAIN = '44'
START_S = 150.0
SETTLE_S = 12.0
"""The templates of the nodes have ended by then."""
UNCHANGED_S = 3.0
LAUNCH_FILE = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node, PushRosNamespace
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    path = [FindPackageShare('humanoid_description'), 'launch', 'description.launch.py']
    mode = {'mode': LaunchConfiguration('mode')}
    return LaunchDescription([
        DeclareLaunchArgument('namespace'),
        DeclareLaunchArgument('mode'),
        GroupAction([
            PushRosNamespace(LaunchConfiguration('namespace')),
            Node(package='humanoid_control', executable='mock_robot', parameters=[mode]),
            Node(package='humanoid_control', executable='sensor_processor'),
            IncludeLaunchDescription(PythonLaunchDescriptionSource(PathJoinSubstitution(path))),
        ]),
    ])
"""


@dataclass(frozen=True)
class Joining:
    """How a new node came to know the fleet: s until all nodes, and until all endpoints."""

    nodes_s: float
    endpoints_s: float
    endpoints: int
    """Publishers, subscriptions, and two for each server and client of a service."""


@dataclass(frozen=True)
class Figures:
    """What a fleet costs in one way of discovery; traffic is a second, or of a new node."""

    joining: list[Joining]
    joined: Traffic
    """What a new node adds until it knows everything."""
    sent: Traffic
    """By all machines at rest, a second."""
    received: Traffic
    """By one machine at rest, a second; on one machine the same as `sent`."""
    cpu_cores: float
    server_cores: float
    memory_mb: float
    server_mb: float
    heard_s: float
    """Until a new node has heard each robot."""
    heard: Traffic
    """What is sent a second while it listens, without what is sent at rest."""


def join(robots: int, endpoints: int) -> None:
    """
    Create a node, wait until it knows the fleet, and print the times as JSON.

    Parameters
    ----------
    robots
        The number of robots.
    endpoints
        How many endpoints there are; with 0, wait until their number stays the same.

    """
    import rclpy

    rclpy.init()
    begin_s = time.monotonic()
    node = rclpy.create_node('newcomer')
    wanted = {(name, f'/robot{index + 1}') for index in range(robots) for name in NODES}
    _wait_until(lambda: wanted <= {*node.get_node_names_and_namespaces()}, 'all nodes')
    nodes_s, found = time.monotonic() - begin_s, endpoints_of(node)
    since_s = last_s = time.monotonic()
    while found < endpoints if endpoints else last_s < since_s + UNCHANGED_S:
        if last_s > begin_s + START_S:
            sys.exit(f'The new node knows {found} endpoints of {endpoints} after {START_S:g} s.')
        time.sleep(0.02)
        last_s, before = time.monotonic(), found
        found = endpoints_of(node)
        since_s = since_s if found == before else last_s
    print(json.dumps([nodes_s, since_s - begin_s, found]), flush=True)


def listen(robots: int) -> None:
    """
    Listen to the joint states of each robot until the process ends; print when all were heard.

    Parameters
    ----------
    robots
        The number of robots.

    """
    from humanoid_common.executing import make_executor
    import rclpy
    from rclpy.executors import ExternalShutdownException
    from rclpy.qos import QoSProfile, ReliabilityPolicy
    from sensor_msgs.msg import JointState

    rclpy.init()
    begin_s = time.monotonic()
    node = rclpy.create_node('listener')
    newest = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    silent = set(range(robots))

    def hear(robot: int) -> Callable[[bytes], None]:
        return lambda _: silent.discard(robot)

    for index in range(robots):
        name = f'/robot{index + 1}/joint_states'
        node.create_subscription(JointState, name, hear(index), newest, raw=True)
    executor = make_executor()
    executor.add_node(node)
    while silent:
        executor.spin_once(timeout_sec=0.1)
    print(time.monotonic() - begin_s, flush=True)
    with suppress(ExternalShutdownException):
        while True:
            executor.spin_once(timeout_sec=1.0)


def _wait_until(is_true: Callable[[], bool], what: str) -> None:
    """Wait for something, or end the program."""
    end_s = time.monotonic() + START_S
    while not is_true():
        if time.monotonic() > end_s:
            sys.exit(f'The new node does not know {what} after {START_S:g} s.')
        time.sleep(0.01)


class Fleet:
    """
    A fleet that runs in one way of discovery.

    Parameters
    ----------
    machines
        The machines: the first one is where nodes join.
    robots
        The number of robots.
    mode
        Of the mock robots.
    environment
        The variables of all programs.
    folder
        For the launch file and the output.

    """

    def __init__(
        self,
        machines: Machines,
        robots: int,
        mode: str,
        environment: Mapping[str, str],
        folder: Path,
    ) -> None:
        self.machines, self.robots, self._mode = machines, robots, mode
        self._environment = environment
        self._log, self._launch_file = folder / 'output.txt', folder / 'robot.launch.py'
        self._launch_file.write_text(LAUNCH_FILE)
        self.launches: list[int] = []

    @contextmanager
    def running(self) -> Iterator[None]:
        """Start all robots, and end them at the end of the block."""
        last = len(self.machines.addresses) - 1
        commands = [
            self.machines.command(
                min(index + 1, last),
                *('ros2', 'launch', str(self._launch_file), *self._arguments(index)),
            )
            for index in range(self.robots)
        ]
        with running(commands, self._environment, self._log) as launches:
            self.launches = [each.pid for each in launches]
            yield

    def _arguments(self, index: int) -> tuple[str, str]:
        """Return the launch arguments of a robot."""
        return f'namespace:=robot{index + 1}', f'mode:={self._mode}'

    @contextmanager
    def server(self) -> Iterator[int]:
        """Run the discovery server on the first machine; yield its process."""
        address = self.machines.addresses[0]
        launch = ('ros2', 'launch', 'humanoid_bringup', 'discovery_server.launch.py')
        command = self.machines.command(0, *launch, f'address:={address}', f'port:={PORT}')
        with running([command], self._environment, self._log) as processes:
            yield processes[0].pid

    def joining(self, endpoints: int) -> Joining:
        """
        Let a node join.

        Parameters
        ----------
        endpoints
            As for `join`.

        """
        done = self._newcomer('join', str(self.robots), str(endpoints))
        printed, _ = done.communicate()
        if done.returncode:
            raise SystemExit(f'{printed}\n{self.output()}')
        return Joining(*json.loads(printed))

    @contextmanager
    def listener(self) -> Iterator[float]:
        """Let a node listen to all robots; yield how many s it took to hear each of them."""
        with self._newcomer('listen', str(self.robots)) as process:
            try:
                assert process.stdout is not None
                yield float(process.stdout.readline())
            finally:
                process.terminate()

    def output(self) -> str:
        """Return the end of what the robots have written."""
        return self._log.read_text(errors='replace')[-4000:]

    def _newcomer(self, *words: str) -> subprocess.Popen[str]:
        """Start this program as a node that joins."""
        command = self.machines.command(0, sys.executable, __file__, *words)
        # A server tells others only of what they share a topic with.
        environment = {**self._environment, 'ROS_SUPER_CLIENT': 'TRUE'}
        if words[0] == 'listen' or 'ROS_DISCOVERY_SERVER' not in environment:
            del environment['ROS_SUPER_CLIENT']
        return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)


def measured(way: str, robots: int, mode: str, seconds: float, runs: int) -> Figures:
    """
    Start a fleet, measure it and end it.

    Parameters
    ----------
    way
        One of `WAYS`.
    robots
        The number of robots.
    mode
        Of the mock robots.
    seconds
        How long its traffic and CPU are measured.
    runs
        How many nodes join, one after the other.

    """
    with (
        TemporaryDirectory() as folder,
        connected(1 if way == 'localhost' else robots + 1) as machines,
    ):
        environment = environment_of(way, machines.addresses[0], folder)
        fleet = Fleet(machines, robots, mode, environment, Path(folder))
        if way == 'server':
            with fleet.server() as server, fleet.running():
                return _figures(fleet, [server], seconds, runs)
        with fleet.running():
            return _figures(fleet, [], seconds, runs)


def _figures(fleet: Fleet, servers: list[int], seconds: float, runs: int) -> Figures:
    """Measure a fleet that has just been started."""
    endpoints = fleet.joining(0).endpoints
    time.sleep(SETTLE_S)
    machines, everything = fleet.machines, [*servers, *fleet.launches]
    before, sent, received = cpu_of(everything), machines.sent(), machines.received()
    server_s = cpu_of(servers)
    begin_s = time.monotonic()
    time.sleep(seconds)
    passed_s = time.monotonic() - begin_s
    sent, received = machines.sent() - sent, machines.received() - received
    cores, server_cores = cpu_of(everything) - before, cpu_of(servers) - server_s
    at_rest = sent / passed_s
    joining, joined = [], []
    for _ in range(runs):
        begin_s, count = time.monotonic(), machines.sent()
        joining.append(fleet.joining(endpoints))
        rest_s = time.monotonic() - begin_s
        more = machines.sent() - count
        joined.append(more - Traffic(at_rest.packets * rest_s, at_rest.bytes * rest_s))
    with fleet.listener() as heard_s:
        count, begin_s = machines.sent(), time.monotonic()
        time.sleep(seconds / 2)
        heard = (machines.sent() - count) / (time.monotonic() - begin_s)
    return Figures(
        joining,
        Traffic(median(each.packets for each in joined), median(each.bytes for each in joined)),
        at_rest,
        received / passed_s / len(machines.addresses),
        cores / passed_s,
        server_cores / passed_s,
        memory_of(everything),
        memory_of(servers),
        heard_s,
        heard - at_rest,
    )


def environment_of(way: str, address: str, folder: str) -> dict[str, str]:
    """
    Return the environment variables of a way of discovery.

    Parameters
    ----------
    way
        One of `WAYS`.
    address
        Where the server listens.
    folder
        For the log files.

    """
    network = ('ROS_STATIC_PEERS', 'ROS_DISCOVERY_SERVER', 'ROS_SUPER_CLIENT')
    kept = {name: text for name, text in os.environ.items() if name not in network}
    extent = 'LOCALHOST' if way == 'localhost' else 'SUBNET'
    server = {'ROS_DISCOVERY_SERVER': f'{address}:{PORT}'} if way == 'server' else {}
    here = {'ROS_AUTOMATIC_DISCOVERY_RANGE': extent, 'ROS_DOMAIN_ID': DOMAIN, 'ROS_HOME': folder}
    return {**kept, **here, **server}


def cpu_of(processes: list[int]) -> float:
    """
    Add the CPU time in s that processes and all their descendants have used.

    Parameters
    ----------
    processes
        The process ids.

    """
    return sum(sum(cpu_by_process(each).values()) for each in processes)


def memory_of(processes: list[int]) -> float:
    """
    Add the memory (PSS, MB) of processes and all their descendants.

    Parameters
    ----------
    processes
        The process ids.

    """
    return sum(pss_mb(each) for process in processes for each in cpu_by_process(process))


def table(figures: Mapping[str, Figures], robots: int) -> str:
    """
    Format the figures of one or several ways as a table of Markdown.

    Parameters
    ----------
    figures
        The figures by way.
    robots
        The number of robots.

    """
    rows: list[tuple[str, Callable[[Figures], str]]] = [
        ('endpoints', lambda each: str(each.joining[0].endpoints)),
        (
            'a new node knows all nodes: mean, longest',
            lambda each: _times([one.nodes_s for one in each.joining]),
        ),
        (
            'and all their endpoints: mean, longest',
            lambda each: _times([one.endpoints_s for one in each.joining]),
        ),
        ('what it adds to the traffic until then', lambda each: _total(each.joined)),
        ('a new node hears each robot', lambda each: f'{each.heard_s:.1f} s'),
        ('traffic at rest, all that is sent', lambda each: _rate(each.sent)),
        ('traffic at rest, received by a machine', lambda each: _rate(each.received)),
        ('the joint states, heard by one node', lambda each: _rate(each.heard)),
        ('CPU of everything, at rest', lambda each: f'{each.cpu_cores:.2f} cores'),
        ('CPU of the server', lambda each: f'{each.server_cores:.2%}'.replace('%', ' %')),
        ('memory of everything (PSS)', lambda each: f'{each.memory_mb:.0f} MB'),
        ('memory of the server', lambda each: f'{each.server_mb:.0f} MB'),
    ]
    lines = [f'| {robots} robots | {" | ".join(figures)} |', '|---' * (len(figures) + 1) + '|']
    for name, text in rows:
        lines.append(f'| {name} | {" | ".join(text(each) for each in figures.values())} |')
    return '\n'.join(lines)


def _times(values_s: list[float]) -> str:
    return f'{mean(values_s):.2f}, {max(values_s):.2f} s'


def _total(traffic: Traffic) -> str:
    return f'{traffic.packets:.0f} packets, {traffic.bytes / 1000:.0f} kB'


def _rate(traffic: Traffic) -> str:
    return f'{traffic.packets:.0f} packets/s, {traffic.bytes / 1000:.1f} kB/s'


def main() -> int:
    """Measure each way and print the table."""
    if len(sys.argv) == 4 and sys.argv[1] == 'join':
        join(int(sys.argv[2]), int(sys.argv[3]))
        return 0
    if len(sys.argv) == 3 and sys.argv[1] == 'listen':
        listen(int(sys.argv[2]))
        return 0
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--robots', type=in_range(int, 1, 200), default=10)
    parser.add_argument('--ways', nargs='+', choices=WAYS, default=WAYS)
    parser.add_argument('--mode', choices=('hold', 'follow', 'walking'), default='hold')
    parser.add_argument('--seconds', type=in_range(float, 1.0), default=20.0, help='at rest')
    parser.add_argument('--runs', type=in_range(int, 1), default=5, help='nodes that join')
    options = parser.parse_args()
    if os.geteuid() != 0:
        parser.error('several machines in one need root.')
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # so that all robots are ended
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job ignores it
    figures = {}
    for way in options.ways:
        figures[way] = measured(way, options.robots, options.mode, options.seconds, options.runs)
        print(f'{way} is measured', file=sys.stderr, flush=True)
    print(table(figures, options.robots))
    return 0


if __name__ == '__main__':
    sys.exit(main())
