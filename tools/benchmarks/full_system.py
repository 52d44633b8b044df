# SPDX-License-Identifier: Apache-2.0
"""
Measure what the full system costs: the time until it is ready, memory, CPU, and its own time.

`tools/in_environment python3 tools/benchmarks/full_system.py --runs 3`. Each run starts
`full_system.launch.py` as users do, waits until the robot says that it is ready and, with the
page, until the page is up, lets it stand, and then walk to another room. Memory is PSS, which
counts what processes share once; CPU is that of all processes, in cores. The real-time factor is
how many seconds of the robot's time pass in a real one.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
import os
from pathlib import Path
import signal
import subprocess
import time

from bringup_run import cpu_by_process, process_name, pss_mb
from domain_coordinator import domain_id
from humanoid_common.executing import make_executor
from humanoid_common.qos import EVENT
from humanoid_common.testing.processes import Capture
import rclpy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String

HERE = Path(__file__).resolve().parents[2]
COMMAND = ('ros2', 'launch', 'humanoid_bringup', 'full_system.launch.py')
READY, PAGE = 'I am ready', 'RViz is at http'
COMMANDS = {'standing': '', 'walking': 'go to the bedroom'}
TIMEOUT_S, SETTLE_S, BEGIN_S, END_S = 180.0, 15.0, 6.0, 60.0


@dataclass(frozen=True)
class Share:
    """The load of all processes: cores, PSS by process, and the real-time factor."""

    cores: float
    memory_mb: dict[str, float]
    factor: float


@dataclass
class Run:
    """The measurements of a run."""

    ready_s: float
    page_s: float = 0.0
    shares: dict[str, Share] = field(default_factory=dict)


def main() -> None:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--runs', type=int, default=1, help='runs with, and without the page')
    parser.add_argument(
        '--seconds', type=float, default=15.0, help='how long each row is measured'
    )
    options = parser.parse_args()
    for gui in ('false', 'true'):
        for _ in range(options.runs):
            print_run(gui, measured_run(gui, options.seconds))


def print_run(gui: str, run: Run) -> None:
    """
    Print the times and shares of a run, and the memory of each process in its last phase.

    Parameters
    ----------
    gui
        `true` or `false`: whether the page was served.
    run
        The measurements.

    """
    page = f', the page is up after {run.page_s:.1f} s' if run.page_s else ''
    print(f'\ngui:={gui}: ready after {run.ready_s:.1f} s{page}')
    for name, share in run.shares.items():
        total_mb = sum(share.memory_mb.values())
        print(
            f'  {name}: {share.cores:.2f} cores, {total_mb:.0f} MB, '
            f'{share.factor:.2f} times real time'
        )
    for name, memory_mb in sorted(share.memory_mb.items(), key=lambda item: -item[1]):
        print(f'{memory_mb:9.1f} MB  {name}')
    print(end='', flush=True)


def measured_run(gui: str, seconds: float) -> Run:
    """
    Start the full system and measure it.

    Parameters
    ----------
    gui
        Whether to serve the page: `true` or `false`.
    seconds
        The duration of the measurement, in real time.

    """
    with domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        rclpy.init()
        listener = Listener()
        begin_s = time.monotonic()
        try:
            with _system(gui) as (launch, output):
                return _measured(listener, launch, output, begin_s, gui == 'true', seconds)
        finally:
            listener.node.destroy_node()
            rclpy.shutdown()


def _measured(
    listener: Listener,
    launch: subprocess.Popen[bytes],
    output: Capture,
    begin_s: float,
    has_page: bool,
    seconds: float,
) -> Run:
    times_s: dict[str, float] = {}

    def look() -> bool:
        now_s = time.monotonic() - begin_s
        if any(READY in each for each in listener.said):
            times_s.setdefault('ready', now_s)
        if PAGE in output.text:
            times_s.setdefault('page', now_s)
        assert launch.poll() is None, output.text
        return 'ready' in times_s and ('page' in times_s or not has_page)

    listener.spin_until(look, TIMEOUT_S)
    run = Run(times_s['ready'], times_s.get('page', 0.0))
    listener.spin(SETTLE_S)
    for name, command in COMMANDS.items():
        if command:
            listener.commands.publish(String(data=command))
            listener.spin(BEGIN_S)
        run.shares[name] = _share(listener, launch.pid, seconds)
    return run


def _share(listener: Listener, process: int, seconds: float) -> Share:
    """Measure for a while."""
    before_s, begin_s, clock_s = cpu_by_process(process), time.monotonic(), listener.time_s()
    time.sleep(seconds)
    after_s, end_s, end_clock_s = cpu_by_process(process), time.monotonic(), listener.time_s()
    cpu_s = sum(used_s - before_s.get(each, 0.0) for each, used_s in after_s.items())
    memory_mb: dict[str, float] = {}
    for each in after_s:
        name = process_name(each)
        memory_mb[name] = memory_mb.get(name, 0.0) + pss_mb(each)
    took_s = end_s - begin_s
    return Share(cpu_s / took_s, memory_mb, (end_clock_s - clock_s) / took_s)


@contextmanager
def _system(gui: str) -> Iterator[tuple[subprocess.Popen[bytes], Capture]]:
    """Run the full system during a `with` block."""
    command = [str(HERE / 'tools' / 'in_environment'), *COMMAND, f'gui:={gui}']
    launch = subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    try:
        yield launch, Capture(launch.stdout)
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait(END_S)


class Listener:
    """A node that records the robot's speech, and sends commands."""

    def __init__(self) -> None:
        self.node = rclpy.create_node('listener')
        self._executor = make_executor()
        self._executor.add_node(self.node)
        self.said: list[str] = []
        self.commands = self.node.create_publisher(String, 'user_command', EVENT)
        self.node.create_subscription(
            String, 'speech/say', lambda message: self.said.append(message.data), EVENT
        )

    def time_s(self) -> float:
        """Return the robot's time; `/clock` is subscribed to only during the call."""
        heard: list[Clock] = []
        subscription = self.node.create_subscription(Clock, '/clock', heard.append, 10)
        self.spin_until(lambda: bool(heard), TIMEOUT_S)
        self.node.destroy_subscription(subscription)
        return float(heard[0].clock.sec + heard[0].clock.nanosec * 1e-9)

    def spin(self, seconds: float) -> None:
        """
        Process messages for some time.

        Parameters
        ----------
        seconds
            The duration, in real time.

        """
        end_s = time.monotonic() + seconds
        self.spin_until(lambda: time.monotonic() > end_s, seconds + 1.0)

    def spin_until(self, is_true: Callable[[], bool], timeout_s: float) -> None:
        """
        Process messages until a condition holds.

        Parameters
        ----------
        is_true
            The condition, which is checked at least every 0.1 s.
        timeout_s
            The maximum time to wait, in real time.

        Raises
        ------
        TimeoutError
            The condition does not become true in time.

        """
        end_s = time.monotonic() + timeout_s
        while not is_true():
            if time.monotonic() > end_s:
                raise TimeoutError(f'Timed out after {timeout_s:g} s; it has said {self.said}.')
            self._executor.spin_once(timeout_sec=0.1)


if __name__ == '__main__':
    main()
