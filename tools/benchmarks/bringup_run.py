# SPDX-License-Identifier: Apache-2.0
"""Start the whole bring-up of a workspace, let the robot stand, and measure its cost."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
import os
from pathlib import Path
import signal
import subprocess
import time
from typing import Any

from domain_coordinator import domain_id
from humanoid_common.executing import make_executor
from measuring import own_node
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String

COMMAND = ('ros2', 'launch', 'humanoid_bringup', 'bringup.launch.py')
TIMEOUT_S = 120.0
SETTLE_S = 15.0
DISCOVERY_S = 3.0
STATE_QOS = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
LISTENING_QOS = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
TICKS_HZ = os.sysconf('SC_CLK_TCK')


@dataclass(frozen=True)
class ProcessCost:
    """CPU time in seconds per simulated second, and memory as PSS."""

    cpu: float
    memory_mb: float


@dataclass(frozen=True)
class Run:
    """The cost of a run, by process name, and the rates of the topics."""

    costs: dict[str, ProcessCost]
    rates_hz: dict[str, float] = field(default_factory=dict)

    @property
    def total_cpu(self) -> float:
        """The CPU time of all processes."""
        return sum(cost.cpu for cost in self.costs.values())

    @property
    def total_mb(self) -> float:
        """The memory of all processes."""
        return sum(cost.memory_mb for cost in self.costs.values())


def measured_run(workspace: Path, seconds: float, with_rates: bool) -> Run:
    """
    Start the bring-up of a workspace and measure it while the robot stands.

    Parameters
    ----------
    workspace
        The folder of a workspace that is built.
    seconds
        The duration of the measurement, in simulated time.
    with_rates
        Whether to count the messages of all topics afterwards, for the same duration.

    """
    with domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        with _bringup(workspace) as launch, own_node('witness') as node:
            witness = _Witness(node)
            witness.wait_until_it_stands()
            begin_s, before_s = witness.time_s(), cpu_by_process(launch.pid)
            time.sleep(seconds)
            end_s, after_s = witness.time_s(), cpu_by_process(launch.pid)
            costs: dict[str, ProcessCost] = {}
            for process, cpu_s in after_s.items():
                share = (cpu_s - before_s.get(process, 0.0)) / (end_s - begin_s)
                name, memory_mb = process_name(process), pss_mb(process)
                other = costs.get(name, ProcessCost(0.0, 0.0))
                costs[name] = ProcessCost(other.cpu + share, other.memory_mb + memory_mb)
            return Run(costs, witness.rates_hz(seconds) if with_rates else {})


@contextmanager
def _bringup(workspace: Path) -> Iterator[subprocess.Popen[bytes]]:
    """Run the bring-up during a `with` block; show its output if the block fails."""
    command = [str(workspace / 'tools' / 'in_environment'), *COMMAND]
    launch = subprocess.Popen(command, stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
    try:
        yield launch
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait(TIMEOUT_S)


class _Witness:
    """Node that subscribes only on request, so that it causes no cost of its own otherwise."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._executor = make_executor()
        self._executor.add_node(node)

    def wait_until_it_stands(self) -> None:
        """Wait until the robot stands and everything has settled."""
        self._first(String, 'walking_state', STATE_QOS)
        end_s = self.time_s() + SETTLE_S
        self._spin_until(lambda: self.time_s() > end_s)

    def time_s(self) -> float:
        """Return the simulated time."""
        message = self._first(Clock, '/clock', LISTENING_QOS)
        return float(message.clock.sec + message.clock.nanosec / 1e9)

    def rates_hz(self, seconds: float) -> dict[str, float]:
        """Subscribe to all topics, and count their messages for a while in simulated time."""
        counts: Counter[str] = Counter()
        for topic, (kind, *_) in self._node.get_topic_names_and_types():
            if self._node.count_publishers(topic):
                self._count(counts, topic, kind)
        self._spin_for(DISCOVERY_S)
        begin_s = self.time_s()
        counts.clear()
        self._spin_for(seconds)
        counted, passed_s = dict(counts), self.time_s() - begin_s
        return {topic: count / passed_s for topic, count in counted.items()}

    def _count(self, counts: Counter[str], topic: str, kind: str) -> None:
        def count(_: bytes) -> None:
            counts[topic] += 1

        self._node.create_subscription(_class(kind), topic, count, LISTENING_QOS, raw=True)

    def _first(self, kind: Any, topic: str, qos: QoSProfile) -> Any:
        """Subscribe until a message has arrived."""
        heard: list[Any] = []
        subscription = self._node.create_subscription(kind, topic, heard.append, qos)
        self._spin_until(lambda: bool(heard))
        self._node.destroy_subscription(subscription)
        return heard[0]

    def _spin_until(self, is_true: Callable[[], bool]) -> None:
        end_s = time.monotonic() + TIMEOUT_S
        while not is_true():
            if time.monotonic() > end_s:
                raise TimeoutError('the robot does not stand; run the bring-up by hand to see why')
            self._executor.spin_once(timeout_sec=0.1)

    def _spin_for(self, seconds: float) -> None:
        end_s = time.monotonic() + seconds
        self._spin_until(lambda: time.monotonic() > end_s)


def _class(kind: str) -> Any:
    """Return the class of a message type, such as `std_msgs/msg/String`."""
    package, _, name = kind.split('/')
    return getattr(import_module(f'{package}.msg'), name)


def cpu_by_process(process: int) -> dict[int, float]:
    """
    Read the CPU time that a process and all its descendants have used so far.

    Parameters
    ----------
    process
        The process id.

    Returns
    -------
    dict of int to float
        Seconds of user and system time by process id, of the processes that are still running.

    """
    found: dict[int, float] = {}
    try:
        fields = Path(f'/proc/{process}/stat').read_text().rpartition(')')[2].split()
        found[process] = (int(fields[11]) + int(fields[12])) / TICKS_HZ
        for task in Path(f'/proc/{process}/task').iterdir():
            for child in (task / 'children').read_text().split():
                found |= cpu_by_process(int(child))
    except (FileNotFoundError, ProcessLookupError):
        pass
    return found


def pss_mb(process: int) -> float:
    """
    Read the proportional set size (PSS) of a process: shared pages are divided among processes.

    Parameters
    ----------
    process
        The process id.

    Returns
    -------
    float
        Memory in MiB, 0 if the process has ended.

    """
    try:
        for line in Path(f'/proc/{process}/smaps_rollup').read_text().splitlines():
            if line.startswith('Pss:'):
                return int(line.split()[1]) / 1024
    except (FileNotFoundError, ProcessLookupError):
        pass
    return 0.0


def process_name(process: int) -> str:
    """
    Read the name of a process: that of its main thread, which nodes set.

    Parameters
    ----------
    process
        The process id.

    """
    return Path(f'/proc/{process}/comm').read_text().strip()
