# SPDX-License-Identifier: Apache-2.0
"""Cut the network between a walking robot and whoever drives it, and measure when it stops.

The mock robot and the driver are on two machines, which are network namespaces with a network
between them that delays packets and loses some. The driver is a teleoperation, which publishes
cmd_vel ten times a second, or a console, which also publishes a heartbeat. The network is cut for
a while, or for good, as the robot walks. The table says how long after the cut the robot learns
that its driver is lost, when it stands, and what it does once the network is back. It needs root.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager, ExitStack
import json
import os
from pathlib import Path
import signal
import subprocess
import sys
from tempfile import TemporaryDirectory
import time
from typing import NamedTuple

from arguments import in_range

ROBOT, DRIVER = '10.231.9.1', '10.231.9.2'
DRIVERS = ('teleop', 'console')
DOMAIN = '43'
START_S = 60.0
FOR_GOOD_S = 8.0
AFTER_S = 4.0
BAD_LINK = Path(__file__).parents[1] / 'test' / 'bad_link.py'


class Event(NamedTuple):
    """What the robot has published, and when, in s of this machine's monotonic clock."""

    time_s: float
    topic: str
    text: str


def drive(kind: str) -> None:
    """
    Drive the robot forward until the process ends.

    Parameters
    ----------
    kind
        What drives, one of `DRIVERS`: a console also publishes a heartbeat.

    """
    from geometry_msgs.msg import Twist, Vector3
    import rclpy
    from rclpy.qos import QoSProfile, ReliabilityPolicy
    from std_msgs.msg import Bool

    rclpy.init()
    node = rclpy.create_node('driver')
    velocity = node.create_publisher(Twist, 'cmd_vel', 1)
    newest = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    heartbeat = node.create_publisher(Bool, 'console_heartbeat', newest)

    def say() -> None:
        velocity.publish(Twist(linear=Vector3(x=0.2)))
        if kind == 'console':
            heartbeat.publish(Bool(data=True))

    node.create_timer(0.1, say)
    rclpy.spin(node)


def watch() -> None:
    """Print what the robot publishes about its walk, until the process ends."""
    import rclpy
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from std_msgs.msg import String

    rclpy.init()
    node = rclpy.create_node('watcher')
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

    def teller(topic: str) -> Callable[[String], None]:
        return lambda message: print(
            json.dumps([time.monotonic(), topic, message.data]), flush=True
        )

    for topic in ('walking_state', 'stop_state'):
        node.create_subscription(String, topic, teller(topic), latched)
    rclpy.spin(node)


class World:
    """
    Two machines with a robot, a driver and a bad network between them.

    Parameters
    ----------
    folder
        For the output of the programs.
    delay_s, loss
        Of the network.

    """

    def __init__(self, folder: Path, delay_s: float, loss: float) -> None:
        self._folder = folder
        self._stack = ExitStack()
        self._names = [f'{each}-{os.getpid()}' for each in ('robot', 'driver')]
        for name in self._names:
            subprocess.run(['ip', 'netns', 'add', name], check=True)
            self._stack.callback(subprocess.run, ['ip', 'netns', 'del', name], check=False)
            subprocess.run(['ip', '-n', name, 'link', 'set', 'lo', 'up'], check=True)
        ends = [f'{name}/{each}' for name, each in zip(self._names, (ROBOT, DRIVER), strict=True)]
        options = ['--delay', str(delay_s), '--loss', str(loss)]
        command = [sys.executable, str(BAD_LINK), *ends, *options]
        self._link = self._stack.enter_context(ended(subprocess.Popen(command, stdout=-1)))
        assert self._link.stdout
        self._link.stdout.readline()

    def close(self) -> None:
        """End all programs, and remove the machines."""
        self._stack.close()

    def run(self, machine: int, *command: str) -> None:
        """
        Start a program on a machine.

        Parameters
        ----------
        machine
            0: that of the robot; 1: that of the driver.
        *command
            The program and its arguments; its output is named after the last one.

        """
        shared = self._folder / self._names[machine]
        shared.mkdir(exist_ok=True)
        script = 'mount --bind "$0" /dev/shm && exec "$@"'
        words = ['ip', 'netns', 'exec', self._names[machine], 'sh', '-c', script, str(shared)]
        env = {
            **os.environ,
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET',
            'ROS_DOMAIN_ID': DOMAIN,
            'ROS_STATIC_PEERS': (DRIVER, ROBOT)[machine],
            'ROS_HOME': str(self._folder),
        }
        log = (self._folder / f'{command[-1]}.txt').open('wb')
        program = subprocess.Popen([*words, *command], env=env, stdout=log, stderr=log)
        self._stack.enter_context(ended(program))

    def cut(self) -> None:
        """Cut the network."""
        self._link.send_signal(signal.SIGUSR1)

    def mend(self) -> None:
        """Connect the machines again."""
        self._link.send_signal(signal.SIGUSR2)

    @property
    def events(self) -> list[Event]:
        """What the robot has published so far."""
        lines = (self._folder / 'watch.txt').read_text().splitlines()
        return [Event(*json.loads(line)) for line in lines if line.startswith('[')]

    def wait_for_walk(self) -> None:
        """Wait until the robot walks."""
        end_s = time.monotonic() + START_S
        while not any(each.text == 'walk' for each in self.events):
            if time.monotonic() > end_s:
                sys.exit(f'the robot does not walk after {START_S:g} s: {self.events}')
            time.sleep(0.05)
        time.sleep(1.0)  # a step or two


@contextmanager
def ended(program: subprocess.Popen[bytes]) -> Iterator[subprocess.Popen[bytes]]:
    """
    Terminate a program at the end of the block.

    Parameters
    ----------
    program
        The program, which runs.

    """
    try:
        yield program
    finally:
        program.terminate()
        program.wait()


def trial(kind: str, cut_s: float, delay_s: float, loss: float) -> str:
    """
    Cut the network once, and return a row of the table.

    Parameters
    ----------
    kind
        What drives the robot, one of `DRIVERS`.
    cut_s
        For how long the network is cut; from `FOR_GOOD_S` on, for good.
    delay_s, loss
        The delay of the network, and the share of datagrams that it loses.

    """
    with TemporaryDirectory() as folder:
        world = World(Path(folder), delay_s, loss)
        try:
            world.run(0, 'ros2', 'run', 'humanoid_control', 'mock_robot')
            world.run(0, sys.executable, __file__, 'watch')
            world.run(1, sys.executable, __file__, kind)
            world.wait_for_walk()
            begin_s = time.monotonic()
            world.cut()
            time.sleep(min(cut_s, FOR_GOOD_S))
            if cut_s < FOR_GOOD_S:
                world.mend()
            time.sleep(AFTER_S)
            later = [each for each in world.events if each.time_s > begin_s]
        finally:
            world.close()
    return row(kind, cut_s, begin_s, later)


def row(kind: str, cut_s: float, begin_s: float, events: list[Event]) -> str:
    """
    Format a row of the table.

    Parameters
    ----------
    kind, cut_s
        As for `trial`.
    begin_s
        When the network was cut, by the clock of the events.
    events
        What the robot published after that.

    """

    def after(topic: str, *texts: str) -> str:
        found = [
            each.time_s - begin_s
            for each in events
            if each.topic == topic and (each.text in texts if texts else each.text)
        ]
        return f'{found[0]:.2f} s' if found else 'never'

    walk = [each.text for each in events if each.topic == 'walking_state']
    length = 'for good' if cut_s >= FOR_GOOD_S else f'{cut_s:g} s'
    lost, stops = after('stop_state'), after('walking_state', 'stop')
    stands = after('walking_state', 'stand')
    return f'| {kind} | {length} | {lost} | {stops} | {stands} | {walk[-1] if walk else "walk"} |'


def main() -> int:
    """Run the trials and print the table."""
    if len(sys.argv) == 2 and sys.argv[1] in (*DRIVERS, 'watch'):
        watch() if sys.argv[1] == 'watch' else drive(sys.argv[1])
        return 0
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        '--cuts',
        type=in_range(float, 0.0),
        nargs='+',
        default=[0.3, 2.0, FOR_GOOD_S],
        help=f'how long, in s; {FOR_GOOD_S:g} or more is for good',
    )
    parser.add_argument('--delay', type=in_range(float, 0.0), default=0.05, help='in s')
    parser.add_argument('--loss', type=in_range(float, 0.0, 1.0), default=0.02)
    options = parser.parse_args()
    if os.geteuid() != 0:
        parser.error('two machines in one need root.')
    print('| driver | cut | driver lost | begins to stop | stands | in the end |')
    print('|---|---|---|---|---|---|')
    for kind in DRIVERS:
        for cut_s in options.cuts:
            print(trial(kind, cut_s, options.delay, options.loss), flush=True)
    return 0


if __name__ == '__main__':
    sys.exit(main())
