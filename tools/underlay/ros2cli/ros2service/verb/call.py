# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 service call`."""

from __future__ import annotations

import argparse

from ros2cli.argument_types import positive_number
from ros2cli.messages.values_arguments import add_values_arguments
from ros2cli.node.arguments import add_node_arguments
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
        from ros2cli.messages.lookup import get_passed_type
        from ros2cli.messages.outgoing import OutgoingMessage
        from ros2cli.messages.values_arguments import values_text
        from ros2cli.names import absolute
        from ros2cli.node.direct import DirectNode
        from ros2service.api.calling import Caller

        service_type = get_passed_type(args.service_type, 'srv')
        request = OutgoingMessage(service_type.Request(), values_text(args))
        name = absolute(args.service_name, 'service')
        with DirectNode(args) as node:
            caller = Caller(node, service_type, name)
            caller.wait_for_service()
            caller.call_repeatedly(request, args.rate)
        return None
