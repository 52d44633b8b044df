# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 service`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class ServiceCommand(VerbCommand):
    """Various service related sub-commands."""

    VERB_GROUP = 'ros2service.verb'
    VERBS = {
        'call': Entry('ros2service.verb.call:CallVerb', 'Call a service'),
        'echo': Entry('ros2service.verb.echo:EchoVerb', 'Echo a service'),
        'find': Entry(
            'ros2service.verb.find:FindVerb', 'Output a list of available services of a given type'
        ),
        'info': Entry('ros2service.verb.info:InfoVerb', 'Print information about a service'),
        'list': Entry('ros2service.verb.list:ListVerb', 'Output a list of available services'),
        'type': Entry('ros2service.verb.type:TypeVerb', "Output a service's type"),
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
            The command line up to the command, `ros2 service`.
        argv
            The arguments after it; the first that is not an option selects the verb to import.

        """
        parser.add_argument(
            '--include-hidden-services',
            action='store_true',
            help='Consider hidden services as well',
        )
        super().add_arguments(parser, cli_name, argv=argv)
