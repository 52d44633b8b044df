# SPDX-License-Identifier: Apache-2.0
"""
Measure how long nodes take to discover each other, and how many endpoints each of them has.

First, a new node waits until it knows the names and all endpoints of the others, which are idle.
Then as many nodes start together, each of which publishes a topic and subscribes to that of the
next one, until the last one has received its first message. All are nodes of rclpy, forked from a
process that has imported it, so that imports do not count; each is a participant of DDS. The rows
differ in what a node has besides its own topics. How they discover each other is what the
environment says:

    tools/in_environment python3 tools/benchmarks/discovery_time.py --nodes 20
    ROS_DISCOVERY_SERVER=127.0.0.1:11811 ROS_SUPER_CLIENT=TRUE tools/in_environment python3 ...
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager, ExitStack, suppress
from dataclasses import dataclass
import multiprocessing
from multiprocessing.connection import Connection
import os
import signal
from statistics import median
import sys
import time
from typing import Any

from arguments import in_range
from domain_coordinator import domain_id
from humanoid_common.executing import make_executor
from measuring import endpoints_of
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

FORK = multiprocessing.get_context('fork')
TIMEOUT_S = 60.0
PERIOD_S = 0.01
SETTLE_S = 3.0
REST_S = 10.0
COLUMNS = (
    'endpoints of each',
    'CPU of each, idle',
    'it joins',
    'its CPU',
    'all start together',
    'CPU of all',
)
KINDS: dict[str, dict[str, Any]] = {
    'an ordinary node': {},
    'without parameter services': {'start_parameter_services': False},
    'also without /rosout': {'start_parameter_services': False, 'enable_rosout': False},
}
Task = Callable[[Connection, int, int, dict[str, Any]], Node]


@dataclass(frozen=True)
class Result:
    """What a new node, or the last of several that start together, measured."""

    time_s: float
    cpu_s: float
    endpoints: int = 0


def idle(connection: Connection, index: int, nodes: int, options: dict[str, Any]) -> Node:
    """
    Be a node with a topic until the connection is closed.

    Parameters
    ----------
    connection
        Gets a word once the node is there.
    index, nodes
        Which of how many nodes it is.
    options
        Keyword arguments of the node.

    """
    rclpy.init()
    node = Node(f'n{index}', **options)
    node.create_publisher(String, f't{index}', 10)
    connection.send('ready')
    while connection.recv() == 'cpu':
        connection.send(time.process_time())
    return node


def join(connection: Connection, index: int, nodes: int, options: dict[str, Any]) -> Node:
    """
    Be a new node, and send how long it takes to know all nodes and their endpoints.

    Parameters
    ----------
    connection
        Gets the result.
    index
        The number of endpoints that are to be known, or 0 if that is to be found out.
    nodes
        The number of the other nodes.
    options
        Keyword arguments of the node.

    """
    rclpy.init()
    begin_s, cpu_s = time.monotonic(), time.process_time()
    node = Node('newcomer', **options)
    names = {f'n{other}' for other in range(nodes)}
    while not names <= {*node.get_node_names()}:
        _rest(begin_s)
    if index:
        while endpoints_of(node) < index:
            _rest(begin_s)
    else:
        time.sleep(SETTLE_S)
    time_s, cpu_s = time.monotonic() - begin_s, time.process_time() - cpu_s
    connection.send(Result(time_s, cpu_s, endpoints_of(node)))
    connection.recv()
    return node


def meet(connection: Connection, index: int, nodes: int, options: dict[str, Any]) -> Node:
    """
    Start a node on a word, and send how long it takes until it hears the next one.

    Parameters
    ----------
    connection
        Gets a word when the process is there, gives one to start, and gets the result.
    index, nodes
        Which of how many nodes it is.
    options
        Keyword arguments of the node.

    """
    connection.send('ready')
    begin_s = connection.recv()
    rclpy.init()
    node = Node(f'n{index}', **options)
    publisher = node.create_publisher(String, f't{index}', 10)
    heard: list[float] = []
    node.create_subscription(
        String, f't{(index + 1) % nodes}', lambda _: heard.append(time.monotonic()), 10
    )
    node.create_timer(PERIOD_S, lambda: publisher.publish(String(data='hello')))
    executor = make_executor()
    executor.add_node(node)
    while not heard:
        if time.monotonic() > begin_s + TIMEOUT_S:
            raise SystemExit(f'Node {index} has heard nothing after {TIMEOUT_S:g} s.')
        executor.spin_once(timeout_sec=0.1)
    connection.send(Result(heard[0] - begin_s, time.process_time()))
    while not connection.poll():  # the one before this one may still wait to hear it
        executor.spin_once(timeout_sec=0.1)
    return node


def _rest(begin_s: float) -> None:
    """Wait before the next look at the graph."""
    if time.monotonic() > begin_s + TIMEOUT_S:
        raise SystemExit(f'The new node does not know all others after {TIMEOUT_S:g} s.')
    time.sleep(0.01)


@contextmanager
def process(task: Task, index: int, nodes: int, options: dict[str, Any]) -> Iterator[Connection]:
    """
    Fork a process for a `with` block, at whose end it ends.

    Parameters
    ----------
    task
        What it does.
    index, nodes, options
        The arguments of the task.

    """
    ours, theirs = FORK.Pipe()
    forked = FORK.Process(target=_child, args=(task, theirs, index, nodes, options), daemon=True)
    forked.start()
    theirs.close()
    try:
        yield ours
    finally:
        with suppress(OSError):  # it has failed
            ours.send('end')
        forked.join()


def _child(
    task: Task, connection: Connection, index: int, nodes: int, options: dict[str, Any]
) -> None:
    """Do a task; end without cleaning up what belongs to the process that was forked."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    node = task(connection, index, nodes, options)
    node.destroy_node()
    rclpy.shutdown()
    os._exit(0)


def joining(nodes: int, options: dict[str, Any], runs: int) -> tuple[float, list[Result]]:
    """
    Start idle nodes, and let new ones join them, one after the other.

    Parameters
    ----------
    nodes
        The number of idle nodes.
    options
        Keyword arguments of all nodes.
    runs
        How many nodes join.

    Returns
    -------
    float, list of Result
        What an idle node uses of a core, and the result of each new one.

    """
    with ExitStack() as stack:
        ends = [
            stack.enter_context(process(idle, index, nodes, options)) for index in range(nodes)
        ]
        for end in ends:
            end.recv()
        time.sleep(SETTLE_S)
        before_s = cpu_of(ends)
        time.sleep(REST_S)
        share = (cpu_of(ends) - before_s) / REST_S / nodes
        results: list[Result] = []
        for _ in range(runs + 1):
            endpoints = results[0].endpoints if results else 0
            with process(join, endpoints, nodes, options) as connection:
                results.append(connection.recv())
        return share, results[1:]


def cpu_of(ends: list[Connection]) -> float:
    """
    Add the CPU time in s that idle nodes have used so far.

    Parameters
    ----------
    ends
        The connections to them.

    """
    for end in ends:
        end.send('cpu')
    return sum(end.recv() for end in ends)


def meeting(nodes: int, options: dict[str, Any]) -> tuple[float, float]:
    """
    Start nodes together.

    Parameters
    ----------
    nodes
        Their number.
    options
        Keyword arguments of each.

    Returns
    -------
    float, float
        When the last one has heard its first message, and the CPU time of all until then, in s.

    """
    with ExitStack() as stack:
        ends = [
            stack.enter_context(process(meet, index, nodes, options)) for index in range(nodes)
        ]
        for end in ends:
            end.recv()
        begin_s = time.monotonic()
        for end in ends:
            end.send(begin_s)
        results: list[Result] = [end.recv() for end in ends]
        return max(each.time_s for each in results), sum(each.cpu_s for each in results)


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--nodes', type=in_range(int, 2, 100), default=20)
    parser.add_argument('--runs', type=in_range(int, 1), default=5, help='runs of each row')
    parser.add_argument('--kinds', nargs='+', choices=KINDS, default=[*KINDS])
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # so that all nodes are ended
    with domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        print(f'| {options.nodes} nodes | {" | ".join(COLUMNS)} |')
        print('|---' * (1 + len(COLUMNS)) + '|')
        for kind in options.kinds:
            print(row(kind, options.nodes, options.runs), flush=True)


def row(kind: str, nodes: int, runs: int) -> str:
    """
    Measure one kind of nodes, and format the row of the table.

    Parameters
    ----------
    kind
        One of `KINDS`.
    nodes
        Their number.
    runs
        How often each way is measured.

    """
    share, joined = joining(nodes, KINDS[kind], runs)
    met = [meeting(nodes, KINDS[kind]) for _ in range(runs)]
    joining_s, meeting_s = [each.time_s for each in joined], [time_s for time_s, _ in met]
    cells = (
        kind,
        f'{(joined[0].endpoints + 1) / (nodes + 1):.0f}',
        f'{share * 100:.2f} %',
        f'{median(joining_s):.2f}, {max(joining_s):.2f} s',
        f'{median(each.cpu_s for each in joined):.2f} s',
        f'{median(meeting_s):.2f}, {max(meeting_s):.2f} s',
        f'{median(cpu_s for _, cpu_s in met):.2f} s',
    )
    return f'| {" | ".join(cells)} |'


if __name__ == '__main__':
    main()
