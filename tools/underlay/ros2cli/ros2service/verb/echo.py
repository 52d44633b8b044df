# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 service echo`, which prints the events of a service with introspection."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from ros2cli.arguments import add_strategy_arguments
from ros2cli.messages.lookup import get_passed_type
from ros2cli.messages.text import plain_to_csv, plain_to_yaml, to_plain
from ros2cli.names import absolute
from ros2cli.waiting import Patience
from ros2service.api import get_service_types, unknown_service_text
from ros2service.verb import VerbExtension
from ros2topic.api.arguments import add_form_arguments, add_qos_arguments

EVENT_SUFFIX = '/_service_event'
EVENTS = ('REQUEST_SENT', 'REQUEST_RECEIVED', 'RESPONSE_SENT', 'RESPONSE_RECEIVED')
"""Constants of `service_msgs/msg/ServiceEventInfo`."""


class EchoVerb(VerbExtension):
    """Echo a service."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the service, the quality of service and the output format.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 service echo`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'service_name', help="Name of the ROS service to echo (e.g. '/add_two_ints')"
        )
        parser.add_argument(
            'service_type', nargs='?', help="Type of the ROS service (e.g. 'std_srvs/srv/SetBool')"
        )
        add_qos_arguments(parser, 'subscription')
        add_form_arguments(parser)
        parser.set_defaults(filter=None, no_lost_messages=True, once=False, raw=False)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the requests and responses until the user stops it.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.direct import DirectNode

        with DirectNode(args) as node:
            _echo(node, absolute(args.service_name, 'service'), args)
        return None


def _echo(node: Any, service: str, args: argparse.Namespace) -> None:
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
    from ros2topic.api.echo import Listener

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
    Listener(node, topic, event_type, args, _event_formatter(args)).listen(float('inf'), patience)


def _event_formatter(args: argparse.Namespace) -> Callable[[Any, Any], str]:
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
    from ros2topic.api.echo import chosen_shortening, SEPARATOR
    from service_msgs.msg import ServiceEventInfo

    shortening = chosen_shortening(args)
    event_names = {getattr(ServiceEventInfo, name): name for name in EVENTS}

    def format_event(event: Any, info: Any) -> str:
        plain = to_plain(event, shortening)
        plain['info']['event_type'] = event_names.get(event.info.event_type, 'UNKNOWN')
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
