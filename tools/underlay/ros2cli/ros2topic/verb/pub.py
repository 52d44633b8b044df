# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 topic pub`."""

from __future__ import annotations

import argparse

from ros2cli.node.arguments import add_node_arguments
from ros2topic.api.pub_arguments import add_pub_arguments
from ros2topic.api.qos_arguments import add_qos_arguments
from ros2topic.verb import VerbExtension

PRIVATE = '~'


class PubVerb(VerbExtension):
    """Publish a message to a topic."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the message, the rate and the quality of service.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 topic pub`; unused.

        """
        add_pub_arguments(parser)
        add_qos_arguments(parser, 'publisher')
        add_node_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Publish until the count is reached or the user stops it.

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
        from ros2topic.api.pub import publish

        message_type = get_passed_type(args.message_type, 'msg')
        if args.topic_name != PRIVATE:
            absolute(args.topic_name.removeprefix(PRIVATE))
        message = OutgoingMessage(message_type(), values_text(args))
        with DirectNode(args, node_name=args.node_name) as node:
            publish(node, message, args)
        return None
