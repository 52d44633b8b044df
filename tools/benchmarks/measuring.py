# SPDX-License-Identifier: Apache-2.0
"""Helpers shared by the benchmarks: the cost of a command, and printing of tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
import os
from pathlib import Path
import signal
from statistics import median
import subprocess
import time
from typing import Any, TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node


@dataclass(frozen=True)
class Cost:
    """The cost of a run, including its children."""

    cpu_s: float
    wall_s: float
    memory_mb: float

    def __str__(self) -> str:
        """Return the columns of COST_HEADER."""
        return f'{self.cpu_s:7.3f} {self.wall_s:7.3f} {self.memory_mb:6.1f}'


COST_HEADER = f'{"CPU s":>7} {"wall s":>7} {"MB":>6}'


def run_once(command: list[str]) -> Cost:
    """
    Run a command with its output suppressed and measure its cost.

    Parameters
    ----------
    command
        The program and its arguments.

    """
    begin_s = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, _, usage = os.wait4(process.pid, 0)
    wall_s = time.monotonic() - begin_s
    return Cost(usage.ru_utime + usage.ru_stime, wall_s, usage.ru_maxrss / 1000)


def median_cost(command: list[str], runs: int) -> Cost:
    """
    Run a command once to warm up, then several times, and return the medians.

    Parameters
    ----------
    command
        The program and its arguments.
    runs
        The number of counted runs.

    """
    costs = [run_once(command) for _ in range(runs + 1)][1:]
    return Cost(
        median(cost.cpu_s for cost in costs),
        median(cost.wall_s for cost in costs),
        median(cost.memory_mb for cost in costs),
    )


def median_of(measure: Callable[[], float], runs: int) -> float:
    """
    Return the median of several measurements after a warm-up measurement.

    Parameters
    ----------
    measure
        Returns a measurement.
    runs
        The number of counted measurements.

    """
    return median([measure() for _ in range(runs + 1)][1:])


@contextmanager
def running(
    command: list[str], last_signal: signal.Signals = signal.SIGTERM
) -> Iterator[subprocess.Popen[bytes]]:
    """
    Run a command with its output suppressed during a `with` block, then end it.

    Parameters
    ----------
    command
        The program and its arguments.
    last_signal
        The signal that ends it, if it has not ended yet.

    Yields
    ------
    Popen
        The process.

    """
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        try:
            yield process
        finally:
            process.send_signal(last_signal)


@contextmanager
def own_node(name: str) -> Iterator[Node]:
    """
    Initialize rclpy and create a node for a `with` block.

    Parameters
    ----------
    name
        The name of the node.

    Yields
    ------
    Node
        The node; nothing spins it.

    """
    import rclpy

    rclpy.init()
    node = rclpy.create_node(name)
    try:
        yield node
    finally:
        node.destroy_node()
        rclpy.shutdown()


def cpu_s(process: int) -> float:
    """
    Read the CPU time in s that a process has used so far, excluding its children.

    Parameters
    ----------
    process
        The process id.

    """
    fields = Path(f'/proc/{process}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def memory_mb(process: int) -> float:
    """
    Read the resident set size (RSS) of a process in MB, including shared pages.

    Parameters
    ----------
    process
        The process id.

    """
    pages = int(Path(f'/proc/{process}/statm').read_text().split()[1])
    return pages * os.sysconf('SC_PAGE_SIZE') / 1e6


def child_of(parent: int, executable: str) -> int:
    """
    Find the child of a process, or the process itself, that runs an executable.

    Parameters
    ----------
    parent
        The id of the process.
    executable
        The file name of the executable or script.

    Returns
    -------
    int
        The process id.

    Raises
    ------
    SystemExit
        There is no such process.

    """
    children = Path(f'/proc/{parent}/task/{parent}/children').read_text().split()
    for number in (*children, str(parent)):
        words = Path(f'/proc/{number}/cmdline').read_bytes().split(b'\0')
        if any(word.endswith(f'/{executable}'.encode()) for word in words[:2]):
            return int(number)
    raise SystemExit(f'Process {parent} has started no {executable}.')


def endpoints_of(node: Any) -> int:
    """
    Count the endpoints that a node knows, its own included: two for each service or client.

    Parameters
    ----------
    node
        The node of rclpy.

    """
    topics = [name for name, _ in node.get_topic_names_and_types()]
    services = [name for name, _ in node.get_service_names_and_types()]
    return sum(node.count_publishers(each) + node.count_subscribers(each) for each in topics) + (
        2 * sum(node.count_services(each) + node.count_clients(each) for each in services)
    )
