# SPDX-License-Identifier: Apache-2.0
"""Complete names from the graph; hidden names are offered if the word has a hidden part."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import NamedTuple

from ros2cli.graph.watch import GraphWatch

ACTION_SUFFIX = '/_action/send_goal'
STATE_SERVICE = ('/get_state', 'lifecycle_msgs/srv/GetState')
LOAD_SERVICE = ('/_container/load_node', 'composition_interfaces/srv/LoadNode')
HIDDEN = '/_'
SPIN_TIME_S = 0.1


def topics(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of the topics.

    Parameters
    ----------
    prefix
        The word to complete; hidden names are listed only if it has a hidden part.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return _visible(prefix, graph_names().topics)


def nodes(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the full names of the nodes.

    Parameters
    ----------
    prefix
        The word to complete; hidden names are listed only if it has a hidden part.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return _visible(prefix, graph_names().nodes)


def lifecycle_nodes(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the full names of the lifecycle nodes.

    Parameters
    ----------
    prefix
        The word to complete; hidden names are listed only if it has a hidden part.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return _visible(prefix, _owners(*STATE_SERVICE))


def containers(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the full names of the component containers.

    Parameters
    ----------
    prefix
        The word to complete; hidden names are listed only if it has a hidden part.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return _visible(prefix, _owners(*LOAD_SERVICE))


def services(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of the services.

    Parameters
    ----------
    prefix
        The word to complete; hidden names are listed only if it has a hidden part.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return _visible(prefix, graph_names().services)


def actions(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of the actions, each of which is a hidden service as well.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    names = graph_names().services
    return [name.removesuffix(ACTION_SUFFIX) for name in names if name.endswith(ACTION_SUFFIX)]


def types_of_topic(name: str) -> list[str]:
    """
    Return the types of a topic; none if it has no publishers or subscriptions.

    Parameters
    ----------
    name
        The name of the topic, with or without the leading slash.

    """
    return graph_names().topics.get(_full(name), [])


def types_of_service(name: str) -> list[str]:
    """
    Return the types of a service; none if it has no servers or clients.

    Parameters
    ----------
    name
        The name of the service, with or without the leading slash.

    """
    return graph_names().services.get(_full(name), [])


def _full(name: str) -> str:
    """Return a name with its leading slash."""
    return name if name.startswith('/') else f'/{name}'


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


class Names(NamedTuple):
    """The names in the graph: topics and services with their types, and full node names."""

    topics: dict[str, list[str]]
    services: dict[str, list[str]]
    nodes: list[str]


def graph_names() -> Names:
    """Read the names in the graph during a short discovery."""
    from ros2node.api import get_node_names

    with GraphWatch(SPIN_TIME_S) as watch:
        graph = watch.settled()
    nodes = get_node_names(node=graph, include_hidden_nodes=True)
    return Names(
        dict(graph.get_topic_names_and_types()),
        dict(graph.get_service_names_and_types()),
        sorted({name.full_name for name in nodes}),
    )
