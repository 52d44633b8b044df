# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 interface proto`."""

from __future__ import annotations

import argparse

from ros2interface.verb import VerbExtension


class ProtoVerb(VerbExtension):
    """Output an interface prototype."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the interface and the choice of quotes.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 interface proto`; unused.

        """
        parser.add_argument(
            'type', help='Show an interface prototype (e.g. "example_interfaces/msg/String")'
        )
        parser.add_argument('--no-quotes', action='store_true', help='Output has no outer quotes')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print a message, a request or a goal with the default values as YAML.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Raises
        ------
        RuntimeError
            There is no such interface.

        """
        from ros2cli.messages.text import to_yaml
        from ros2interface.definition import create_prototype

        text = to_yaml(create_prototype(args.type))
        print(text if args.no_quotes else f'"{text}"')
        return None
