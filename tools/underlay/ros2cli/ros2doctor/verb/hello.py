# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 doctor hello`: exchange greetings with other hosts, and count those received."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Iterator
import os
import socket
import struct
import time

from ros2cli.arguments import add_node_arguments, positive_number
from ros2doctor.verb import VerbExtension
from ros2multicast.api import time_to_live

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import Any  # noqa: I300

GROUP, PORT = '225.0.0.1', 49150
LONGEST_GREETING = 256
SPIN_S = 0.02

Sources = Counter[str]


class HelloVerb(VerbExtension):
    """Check network connectivity between multiple hosts."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the topic, the periods and the TTL.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 doctor hello`; unused.

        """
        add_node_arguments(parser)
        add = parser.add_argument
        add('-t', '--topic', default='/canyouhearme', help='Topic to greet on (%(default)s)')
        add(
            '-ep',
            '--emit-period',
            metavar='SECONDS',
            type=positive_number,
            default=0.1,
            help='Time between two greetings (%(default)s)',
        )
        add(
            '-pp',
            '--print-period',
            metavar='SECONDS',
            type=positive_number,
            default=1.0,
            help='Time between two tables (%(default)s)',
        )
        add(
            '--ttl',
            metavar='N',
            type=time_to_live,
            default=1,
            help='Hops of multicast; 1 stays in the local network (%(default)s)',
        )
        add('-1', '--once', action='store_true', help='Print one table and exit')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Exchange greetings with hosts that run the same command, and print who was heard.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.direct import DirectNode

        with DirectNode(args) as node:
            greet(node, args)
        return None


def greet(node: Any, args: argparse.Namespace) -> None:
    """
    Exchange greetings with other hosts, by topic and by multicast, and print who was heard.

    Each print period ends with a table of the greetings received in it.

    Parameters
    ----------
    node
        The `DirectNode` that publishes and subscribes to the topic.
    args : argparse.Namespace
        The options `topic`, `ttl`, `emit_period` and `print_period` (s), and `once`, which ends
        this after the first table.

    """
    name = f'{socket.gethostname()}/{os.getpid()}'
    by_topic: Sources = Counter()
    by_multicast: Sources = Counter()
    publish = _join_topic(node, args.topic, name, by_topic)
    with MulticastGroup(args.ttl) as group:
        while True:
            for _ in _periods(args.print_period, args.emit_period):
                publish()
                group.send(name)
                _receive(node, group, args.emit_period, by_multicast)
            print(table(args.topic, by_topic, by_multicast, name))
            if args.once:
                return
            by_topic.clear()
            by_multicast.clear()


def table(topic: str, by_topic: Sources, by_multicast: Sources, own: str) -> str:
    """
    Format a table of the greetings received from each process by topic and by multicast.

    Parameters
    ----------
    topic
        The name of the topic, which heads its column.
    by_topic, by_multicast
        Number of greetings received each way, by name of the sender (`host/pid`).
    own
        The name of this process, whose row is marked, and present even without greetings.

    Returns
    -------
    str
        The table, with an empty line at the end.

    """
    names = sorted({own, *by_topic, *by_multicast})
    width = max(map(len, names)) + len(' (this process)')
    way = f'{GROUP}:{PORT}'
    lines = ['MULTIMACHINE COMMUNICATION SUMMARY', f'{"heard from":<{width}} {topic} {way}']
    for name in names:
        label = f'{name} (this process)' if name == own else name
        counts = f'{by_topic[name]:>{len(topic)}} {by_multicast[name]:>{len(way)}}'
        lines.append(f'{label:<{width}} {counts}')
    return '\n'.join([*lines, ''])


class MulticastGroup:
    """
    Member of the multicast group that all hosts greet; use it in a `with` statement.

    Parameters
    ----------
    ttl
        Time to live of the packets sent (0 to 255): with 1 they stay in this network, and each
        router to pass requires one more.

    Attributes
    ----------
    error
        Why joining the group, for which the port must not be in exclusive use by another program,
        or sending a greeting failed; None without a failure.

    Raises
    ------
    OSError
        The TTL is out of range.

    """

    def __init__(self, ttl: int) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        set_option = self._socket.setsockopt
        set_option(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        set_option(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        set_option(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, ttl)
        self._socket.setblocking(False)
        try:
            self._socket.bind(('', PORT))
            membership = socket.inet_aton(GROUP) + struct.pack('I', socket.INADDR_ANY)
            set_option(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        except OSError as error:
            self.error: OSError | None = error
        else:
            self.error = None

    def __enter__(self) -> MulticastGroup:
        """Print a message if the group could not be joined."""
        if self.error:
            print(f'multicast does not work on this machine: {self.error.strerror}')
        return self

    def __exit__(self, *error: object) -> None:
        """Leave the group."""
        self._socket.close()

    def send(self, name: str) -> None:
        """
        Send a greeting to all hosts of the group; an error is kept in `error`, not raised.

        Parameters
        ----------
        name
            The name of the sender (`host/pid`), which is the whole greeting.

        """
        try:
            self._socket.sendto(name.encode(), (GROUP, PORT))
        except OSError as error:
            self.error = error

    def received(self) -> Iterator[str]:
        """Yield the greetings received since the last call."""
        while True:
            try:
                yield self._socket.recv(LONGEST_GREETING).decode(errors='replace')
            except OSError:
                return


def _join_topic(node: Any, topic: str, name: str, heard: Sources) -> Callable[[], None]:
    """Count the greetings on a topic; return the function that publishes one."""
    from std_msgs.msg import String

    def count(message: Any) -> None:
        heard[message.data] += 1

    node.create_subscription(String, topic, count, 10)
    publisher = node.create_publisher(String, topic, 10)
    return lambda: publisher.publish(String(data=name))


def _periods(whole_s: float, part_s: float) -> range:
    return range(max(1, round(whole_s / part_s)))


def _receive(node: Any, group: MulticastGroup, duration_s: float, heard: Sources) -> None:
    end = time.monotonic() + duration_s
    while time.monotonic() < end:
        node.spin_once(min(SPIN_S, duration_s))
        heard.update(group.received())
