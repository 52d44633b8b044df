# SPDX-License-Identifier: Apache-2.0
"""Complete what is in the graph; hidden names are offered if the word asks for them."""

from __future__ import annotations

import argparse
from collections.abc import Iterable

from ros2cli.completion.names import graph_names

ACTION_SUFFIX = '/_action/send_goal'
STATE_SERVICE = ('/get_state', 'lifecycle_msgs/srv/GetState')
LOAD_SERVICE = ('/_container/load_node', 'composition_interfaces/srv/LoadNode')
HIDDEN = '/_'


def topics(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the names of the topics."""
    return _visible(prefix, graph_names().topics)


def nodes(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the full names of the nodes."""
    return _visible(prefix, graph_names().nodes)


def lifecycle_nodes(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the full names of the nodes with a life cycle."""
    return _visible(prefix, _owners(*STATE_SERVICE))


def containers(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the full names of the containers of components."""
    return _visible(prefix, _owners(*LOAD_SERVICE))


def services(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the names of the services."""
    return _visible(prefix, graph_names().services)


def actions(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the names of the actions, each of which is a hidden service as well."""
    names = graph_names().services
    return [name.removesuffix(ACTION_SUFFIX) for name in names if name.endswith(ACTION_SUFFIX)]


def types_of_topic(name: str) -> list[str]:
    """Return the types of a topic; none if nobody uses it."""
    return graph_names().topics.get(name, [])


def types_of_service(name: str) -> list[str]:
    """Return the types of a service; none if nobody uses it."""
    return graph_names().services.get(name, [])


def _owners(suffix: str, service_type: str) -> list[str]:
    """Return the nodes that offer a service of this type under their own name."""
    found = graph_names().services.items()
    return [
        name.removesuffix(suffix)
        for name, types in found
        if name.endswith(suffix) and service_type in types
    ]


def _visible(prefix: str, names: Iterable[str]) -> list[str]:
    return [name for name in names if HIDDEN in prefix or HIDDEN not in name]
