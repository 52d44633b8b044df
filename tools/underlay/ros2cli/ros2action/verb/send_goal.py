# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 action send_goal`."""

from __future__ import annotations

import argparse

from ros2action.verb import VerbExtension
from ros2cli.arguments import add_node_arguments
from ros2cli.messages.values import add_values_arguments

FIELD_ERROR = 'Failed to populate message fields: {!r}'


class SendGoalVerb(VerbExtension):
    """Send an action goal."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the action's name and type, the values of the goal and the option for feedback.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_node_arguments(parser)
        parser.add_argument('action_name', help="Name of the ROS action (e.g. '/fibonacci')")
        parser.add_argument(
            'action_type', help="Type of the ROS action (e.g. 'tf2_msgs/action/LookupTransform')"
        )
        add_values_arguments(parser, 'goal')
        parser.add_argument(
            '-f', '--feedback', action='store_true', help='Echo feedback messages for the goal'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Send a goal and print its result; Ctrl-C or SIGTERM cancels the goal.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Raises
        ------
        RuntimeError
            The type, the name or the values are wrong, or the server disappears.

        """
        from ros2action.api import action_hint
        from ros2action.sending import GoalSender
        from ros2cli.messages.lookup import get_passed_type, type_name
        from ros2cli.messages.outgoing import OutgoingMessage
        from ros2cli.messages.values import values_text
        from ros2cli.names import absolute
        from ros2cli.node.direct import DirectNode

        action_type = get_passed_type(args.action_type, 'action')
        goal = OutgoingMessage(action_type.Goal(), values_text(args), FIELD_ERROR)
        name = absolute(args.action_name, 'action')
        with DirectNode(args, survives_interrupt=True) as node:
            sender = GoalSender(node, action_type, name, with_feedback=args.feedback)
            sender.wait_for_server(lambda: action_hint(node.graph, name, type_name(action_type)))
            sender.send(goal)
        return None
