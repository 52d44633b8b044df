# SPDX-License-Identifier: Apache-2.0
"""The network as DDS sees it: variables, interfaces, multicast, shared memory."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
import os
from pathlib import Path

from ros2cli.graph.interfaces import Interface, read_interfaces
from ros2doctor.facts.multicast import has_multicast_route, multicast_error
from ros2doctor.facts.shared_memory import read_shared_memory, SharedMemory

PORT_RANGE = Path('/proc/sys/net/ipv4/ip_local_port_range')
USUAL_PORT_RANGE = (32768, 60999)


@dataclass(frozen=True)
class Network:
    """
    Facts that discovery depends on.

    :param multicast: why multicast is not delivered, if it is not, by name of interface
    :param has_multicast_route: whether it has a route if no interface is named, as in Fast DDS
    :param ephemeral_ports: the range of ports that the kernel assigns automatically
    :param shared_memory: the shared memory for messages on this machine; None without any
    """

    variables: Mapping[str, str]
    interfaces: tuple[Interface, ...]
    multicast: Mapping[str, OSError | None]
    has_multicast_route: bool
    ephemeral_ports: tuple[int, int]
    shared_memory: SharedMemory | None


def read_network() -> Network:
    """Return the network facts of this process."""
    interfaces = tuple(read_interfaces())
    return Network(
        variables=dict(os.environ),
        interfaces=interfaces,
        multicast={
            each.name: multicast_error(each.address)
            for each in interfaces
            if each.is_up and each.address
        },
        has_multicast_route=has_multicast_route(),
        ephemeral_ports=_ephemeral_ports(),
        shared_memory=read_shared_memory(),
    )


def _ephemeral_ports() -> tuple[int, int]:
    try:
        first, last = PORT_RANGE.read_text(encoding='ascii').split()
    except (OSError, ValueError):
        return USUAL_PORT_RANGE
    return int(first), int(last)
