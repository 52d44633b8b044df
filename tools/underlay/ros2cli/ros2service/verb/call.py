# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 service call`, with a client that prints requests and responses."""

from __future__ import annotations

import argparse
import time
from typing import Any

from ros2cli.arguments import add_node_arguments, positive_number
from ros2cli.messages.lookup import get_passed_type, type_name
from ros2cli.messages.outgoing import OutgoingMessage
from ros2cli.messages.values import add_values_arguments, values_text
from ros2cli.names import absolute
from ros2cli.waiting import Patience, spin_until, wait_for_response, wait_until
from ros2service.api import get_service_types, service_hint
from ros2service.verb import VerbExtension


class CallVerb(VerbExtension):
    """Call a service."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the service, the values of the request and the rate of the calls.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 service call`; unused.

        """
        parser.add_argument(
            'service_name', help="Name of the ROS service to call to (e.g. '/add_two_ints')"
        )
        parser.add_argument(
            'service_type', help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')"
        )
        add_values_arguments(parser, 'service request')
        parser.add_argument(
            '-r',
            '--rate',
            metavar='N',
            type=positive_number,
            help='Repeat the call at a specific rate in Hz',
        )
        add_node_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Call the service once, or at a rate until the user stops it.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.direct import DirectNode

        service_type = get_passed_type(args.service_type, 'srv')
        request = OutgoingMessage(service_type.Request(), values_text(args))
        name = absolute(args.service_name, 'service')
        with DirectNode(args) as node:
            caller = _Caller(node, service_type, name)
            caller.wait_for_service()
            caller.call_repeatedly(request, args.rate)
        return None


class _Caller:
    """
    Service client that prints the requests and responses.

    The client is created at once, but may connect later: call `wait_for_service` first.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    service_type
        The class of the service.
    name
        Full name of the service.

    """

    def __init__(self, node: Any, service_type: Any, name: str) -> None:
        self._node = node
        self._client = node.create_client(service_type, name)
        self._name = name
        self._type_name = type_name(service_type)

    def wait_for_service(self) -> None:
        """Wait for the service without a timeout, and report if it is not available at once."""
        if not self._is_offered():
            print('waiting for service to become available...')
        patience = Patience(f"the service '{self._name}'", self._hint)
        wait_until(self._node, self._client.service_is_ready, patience)

    def call_repeatedly(self, request: OutgoingMessage, rate_hz: float | None) -> None:
        """
        Call the service once, or endlessly at a rate.

        Parameters
        ----------
        request
            The request; its time stamps are updated for each call.
        rate_hz
            Calls per second, each after the response to the last one; None for a single call.

        Raises
        ------
        RuntimeError
            The service disappears before it responds.

        """
        next_s = time.monotonic()
        while True:
            self._call(request.stamped(self._node.get_clock().now().to_msg()))
            if rate_hz is None:
                return
            next_s += 1.0 / rate_hz
            spin_until(self._node, next_s)

    def _call(self, request: Any) -> None:
        print(f'requester: making request: {request!r}\n')
        future = self._client.call_async(request)
        response = wait_for_response(self._node, self._client, future)
        print(f'response:\n{response!r}\n')

    def _is_offered(self) -> bool:
        """Whether the service is offered with this type, and is therefore about to connect."""
        graph = self._node.graph
        types = get_service_types(graph, self._name)
        return bool(graph.count_services(self._name)) and self._type_name in types

    def _hint(self) -> str:
        return service_hint(self._node.graph, self._name, self._type_name)
