# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 service echo`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import add_strategy_arguments
from ros2service.verb import VerbExtension
from ros2topic.api.arguments import add_form_arguments, add_qos_arguments


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
        from ros2cli.names import absolute
        from ros2cli.node.direct import DirectNode
        from ros2service.echo import echo

        with DirectNode(args) as node:
            echo(node, absolute(args.service_name, 'service'), args)
        return None
