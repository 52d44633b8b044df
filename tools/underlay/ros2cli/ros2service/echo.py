# SPDX-License-Identifier: Apache-2.0
"""Print the events of a service with introspection enabled."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from ros2cli.messages.lookup import get_passed_type
from ros2cli.messages.plain import to_plain
from ros2cli.messages.text import plain_to_csv, plain_to_yaml
from ros2cli.waiting import Patience
from ros2service.api import get_service_types, unknown_service_text
from ros2topic.api.echo import chosen_shortening, Listener, SEPARATOR
from service_msgs.msg import ServiceEventInfo

EVENT_SUFFIX = '/_service_event'
EVENT_NAMES = {
    getattr(ServiceEventInfo, name): name
    for name in ('REQUEST_SENT', 'REQUEST_RECEIVED', 'RESPONSE_SENT', 'RESPONSE_RECEIVED')
}


def echo(node: Any, service: str, args: argparse.Namespace) -> None:
    """
    Print the introspection events of a service endlessly: its requests and responses.

    Parameters
    ----------
    node
        The `DirectNode` that subscribes.
    service
        Full name of the service.
    args : argparse.Namespace
        The parsed command line; without `service_type` the type is read from the graph.

    Raises
    ------
    RuntimeError
        The type is invalid, not known yet, or not the only one of the service.

    """
    type_name = args.service_type or _discovered_type(node, service)
    event_type = get_passed_type(type_name, 'srv').Event
    topic = f'{service}{EVENT_SUFFIX}'

    def hint() -> str:
        if node.graph.count_publishers(topic):
            return ''
        return (
            'No node publishes them: the server or a client must turn its introspection on, '
            'with configure_introspection().'
        )

    patience = Patience(f"events of the service '{service}'", hint)
    Listener(node, topic, event_type, args, event_formatter(args)).listen(float('inf'), patience)


def event_formatter(args: argparse.Namespace) -> Callable[[Any, Any], str]:
    """
    Create the function that formats service events according to the options.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed command line with the options of `add_form_arguments`.

    Returns
    -------
    callable
        Accepts the event message and its message info; returns the text, YAML or CSV.

    """
    shortening = chosen_shortening(args)

    def format_event(event: Any, info: Any) -> str:
        plain = to_plain(event, shortening)
        plain['info']['event_type'] = EVENT_NAMES.get(event.info.event_type, 'UNKNOWN')
        if args.csv:
            return f'{plain_to_csv(plain)}\n'
        return f'{plain_to_yaml(plain, flow_style=args.flow_style)}{SEPARATOR}\n'

    return format_event


def _discovered_type(node: Any, service: str) -> str:
    graph = node.watch.settled_with(lambda graph: get_service_types(graph, service))
    types = get_service_types(graph, service)
    if not types:
        print(f'WARNING: service [{service}] does not appear to be available yet')
        _, _, hint = unknown_service_text(graph, service).partition('\n')
        text = 'Could not determine the type for the passed service'
        raise RuntimeError('\n'.join([text, hint]).rstrip())
    if len(types) > 1:
        raise RuntimeError(
            f"Cannot echo service '{service}', as it contains more than one type: "
            f'[{", ".join(types)}]'
        )
    return types[0]
