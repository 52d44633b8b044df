# SPDX-License-Identifier: Apache-2.0
"""
Complete names from the graph, and those of a node's parameters.

Hidden names are offered if the word has a hidden part. Users who press TAB often press it again,
to see the choices or after one more letter, so the answers of nodes are cached for a short while.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from contextlib import suppress
import json
import os
from pathlib import Path
import time
from typing import Any, NamedTuple
from urllib.parse import quote

from ros2cli.graph.census import participant_ports
from ros2cli.graph.reach import read_reach

ACTION_SUFFIX = '/_action/send_goal'
STATE_SERVICE = ('/get_state', 'lifecycle_msgs/srv/GetState')
LOAD_SERVICE = ('/_container/load_node', 'composition_interfaces/srv/LoadNode')
HIDDEN = '/_'
SPIN_TIME_S = 0.1
TIMEOUT_S = 1.5
REMEMBERED_S = 8.0


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
    from ros2cli.graph.watch import GraphWatch
    from ros2node.api import get_node_names

    with GraphWatch(SPIN_TIME_S) as watch:
        graph = watch.settled()
    nodes = get_node_names(node=graph, include_hidden_nodes=True)
    return Names(
        dict(graph.get_topic_names_and_types()),
        dict(graph.get_service_names_and_types()),
        sorted({name.full_name for name in nodes}),
    )


def parameters(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of a node's parameters.

    Parameters
    ----------
    prefix
        The word to complete (unused).
    args : argparse.Namespace
        The parsed arguments, with the `node_name`.

    """
    service = f'/{args.node_name.lstrip("/")}/list_parameters'
    names: list[str] | None = recall(service)
    if names is None:
        names = _ask_node(service)
        if names:
            remember(service, names)
    return names


def _ask_node(service: str) -> list[str]:
    from rcl_interfaces.srv import ListParameters
    from ros2cli.node.direct import DirectNode

    with DirectNode(None) as node:
        client = node.create_client(ListParameters, service)
        if not client.wait_for_service(timeout_sec=TIMEOUT_S):
            return []
        future = client.call_async(ListParameters.Request())
        node.executor.spin_until_future_complete(future, timeout_sec=TIMEOUT_S)
        response = future.result() if future.done() else None
    return sorted(response.result.names) if response else []


def recall(subject: str) -> Any:
    """
    Read cached data from the file system.

    Parameters
    ----------
    subject
        The key under which `remember` has stored them.

    Returns
    -------
    Any
        The data; None if there are none, after 8 s, or when participants on this machine have
        joined or left.

    """
    path = _cache_path(subject)
    try:
        if time.time() - path.stat().st_mtime > REMEMBERED_S:
            return None
        neighbours, data = json.loads(path.read_text(encoding='utf-8'))
    except (OSError, ValueError):
        return None
    return data if neighbours == participant_ports(read_reach().domain_id) else None


def remember(subject: str, data: Any) -> None:
    """
    Cache data in the file system; a failure to do so is ignored.

    The file is replaced atomically, so that another shell never reads a partial one.

    Parameters
    ----------
    subject
        The key, such as the name of the service that was called.
    data
        Any JSON-serializable data except None.

    """
    path = _cache_path(subject)
    new = path.with_name(f'{path.name}.{os.getpid()}')
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        new.write_text(
            json.dumps([participant_ports(read_reach().domain_id), data]), encoding='utf-8'
        )
        new.replace(path)
        return
    with suppress(OSError):
        new.unlink()


def _cache_path(subject: str) -> Path:
    """Return the cache file for a subject, by what this shell discovers."""
    folder = Path(os.path.expanduser(os.environ.get('ROS_HOME') or '~/.ros'))
    reach = read_reach()
    servers = ';'.join(str(each) for each in reach.servers)
    name = quote(f'{reach.domain_id}_{reach.extent}_{servers}_{subject}', safe='')
    return folder / 'completion' / f'{name}.json'
