# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic echo`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import add_strategy_arguments
from ros2topic.api.arguments import add_echo_arguments, add_qos_arguments
from ros2topic.verb import VerbExtension


class EchoVerb(VerbExtension):
    """Output messages from a topic."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the topic, the quality of service and the output format.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic echo`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'topic_name', help="Name of the ROS topic to listen to (e.g. '/chatter')"
        )
        parser.add_argument(
            'message_type', nargs='?', help="Type of the ROS message (e.g. 'std_msgs/msg/String')"
        )
        add_qos_arguments(parser, 'subscription')
        add_echo_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print messages until the limit is reached or the user stops it.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.names import absolute
        from ros2cli.node.direct import DirectNode
        from ros2topic.api.echo import echo
        from ros2topic.api.subscribing import resolve_type

        topic = absolute(args.topic_name)
        with DirectNode(args) as node:
            echo(node, topic, resolve_type(node, topic, args.message_type), args)
        return None
