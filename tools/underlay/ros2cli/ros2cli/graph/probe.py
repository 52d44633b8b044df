# SPDX-License-Identifier: Apache-2.0
"""Whether a discovery server answers at an address, and which one it is."""

from __future__ import annotations

from collections.abc import Sequence
import select
import socket
import threading
import time
from typing import NamedTuple

from ros2cli.graph.servers import Server, UDP, udp_host
from ros2cli.rtps.announcement import farewell, greeting, new_prefix
from ros2cli.rtps.identifiers import VENDOR_EPROSIMA
from ros2cli.rtps.message import sender
from ros2cli.rtps.super_client import server_number

TIMEOUT_S = 1.0
PATIENCE_S = 3.0
PERIOD_S = 0.1
MAX_DATAGRAM_BYTES = 65536


class Answer(NamedTuple):
    """
    How an address has answered.

    :param server: what ROS_DISCOVERY_SERVER says
    :param number: the ID of the server that has answered; None if it is not known
    :param error: why there is no server, or ''
    :param is_unresolved: whether the name of its host has no address
    """

    server: Server
    number: int | None = None
    error: str = ''
    is_unresolved: bool = False


def ask_servers(
    servers: Sequence[Server], timeout_s: float = TIMEOUT_S, patience_s: float = PATIENCE_S
) -> tuple[Answer, ...]:
    """
    Ask several addresses at the same time whether a discovery server answers.

    Parameters
    ----------
    servers
        The servers.
    timeout_s
        How long to wait for an answer, in s.
    patience_s
        How long to wait for all of them, in s: to resolve a name may take much longer.

    Returns
    -------
    tuple of Answer
        The answers, in the order of the servers.

    """
    answers: dict[Server, Answer] = {}

    def ask(server: Server) -> None:
        answers[server] = ask_server(server, timeout_s)

    # The resolver cannot be interrupted, and nobody waits for a daemon at the end.
    threads = [threading.Thread(target=ask, args=(each,), daemon=True) for each in servers]
    for thread in threads:
        thread.start()
    end_s = time.monotonic() + patience_s
    for thread in threads:
        thread.join(max(0.0, end_s - time.monotonic()))
    late = f'its name could not be resolved within {patience_s:g} s'
    return tuple(
        answers.get(each) or Answer(each, error=late, is_unresolved=True) for each in servers
    )


def ask_server(server: Server, timeout_s: float = TIMEOUT_S) -> Answer:
    """
    Ask whether a discovery server answers.

    Parameters
    ----------
    server
        The server. With TCP a connection has to suffice, and its ID remains unknown.
    timeout_s
        How long to wait for the answer, in s.

    """
    try:
        if server.kind.startswith('TCP'):
            with socket.create_connection((server.host, server.port), timeout_s):
                return Answer(server)
        return _ask(server, udp_host(server), timeout_s)
    except ConnectionRefusedError:
        return Answer(server, error='no program listens at this port there')
    except OSError as error:
        return Answer(server, error=error.strerror or str(error) or type(error).__name__)
    except (RuntimeError, UnicodeError) as error:  # the latter for names that none can have
        return Answer(server, error=str(error), is_unresolved=server.kind == UDP)


def _ask(server: Server, host: str, timeout_s: float) -> Answer:
    """Greet a server, which answers from another port, until it does."""
    prefix = new_prefix(VENDOR_EPROSIMA)
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asks,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as hears,
    ):
        asks.connect((host, server.port))  # so that a refusal is told
        hears.bind((asks.getsockname()[0], 0))
        hears.setblocking(False)
        hello = greeting(prefix, [hears.getsockname()])
        end_s = time.monotonic() + timeout_s
        while time.monotonic() < end_s:
            asks.send(hello)
            if select.select([hears], [], [], PERIOD_S)[0]:
                number = server_number(sender(hears.recv(MAX_DATAGRAM_BYTES)) or b'')
                if number is not None:
                    asks.send(farewell(prefix))
                    return Answer(server, number)
    return Answer(server, error=f'there is no answer within {timeout_s:g} s')
