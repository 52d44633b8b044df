# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 topic`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class TopicCommand(VerbCommand):
    """Various topic related sub-commands."""

    VERB_GROUP = 'ros2topic.verb'
    VERBS = {
        'bw': Entry('ros2topic.verb.bw:BwVerb', 'Display bandwidth used by topic'),
        'delay': Entry(
            'ros2topic.verb.delay:DelayVerb', 'Display delay of topic from timestamp in header'
        ),
        'echo': Entry('ros2topic.verb.echo:EchoVerb', 'Output messages from a topic'),
        'find': Entry(
            'ros2topic.verb.find:FindVerb', 'Output a list of available topics of a given type'
        ),
        'hz': Entry('ros2topic.verb.hz:HzVerb', 'Print the average publishing rate to screen'),
        'info': Entry('ros2topic.verb.info:InfoVerb', 'Print information about a topic'),
        'list': Entry('ros2topic.verb.list:ListVerb', 'Output a list of available topics'),
        'pub': Entry('ros2topic.verb.pub:PubVerb', 'Publish a message to a topic'),
        'type': Entry('ros2topic.verb.type:TypeVerb', "Print a topic's type"),
    }

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: Sequence[str] | None = None
    ) -> None:
        """
        Add the option shared by all verbs, then the verbs.

        Parameters
        ----------
        parser
            The parser of the command.
        cli_name
            The command line up to the command, `ros2 topic`.
        argv
            The arguments after it; the first that is not an option selects the verb to import.

        """
        parser.add_argument(
            '--include-hidden-topics', action='store_true', help='Consider hidden topics as well'
        )
        super().add_arguments(parser, cli_name, argv=argv)
