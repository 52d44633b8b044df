# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 interface show`."""

from __future__ import annotations

import argparse
import sys

from ros2interface.verb import VerbExtension

STDIN = '-'


class ShowVerb(VerbExtension):
    """Output the interface definition."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the interface and the choice of comments.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 interface show`; unused.

        """
        parser.add_argument(
            'type',
            help='Show an interface definition (e.g. "example_interfaces/msg/String"). '
            'Passing "-" reads the argument from stdin',
        )
        comments = parser.add_mutually_exclusive_group()
        comments.add_argument(
            '--all-comments',
            action='store_true',
            help='Show all comments, including for all nested interface definitions',
        )
        comments.add_argument(
            '--no-comments', action='store_true', help='Show no comments or whitespace'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the definition of an interface, with those of its fields' types below the fields.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Raises
        ------
        RuntimeError
            There is no such interface, or standard input should name one and does not.

        """
        from ros2interface.definition import expand, read_definition

        lines = expand(
            read_definition(_type_or_stdin(args.type)),
            all_comments=args.all_comments,
            no_comments=args.no_comments,
        )
        for line in list(lines):
            print(line)
        return None


def _type_or_stdin(text: str) -> str:
    """Return the name of a type, which may be the first line of standard input."""
    if text != STDIN:
        return text
    if sys.stdin.isatty():
        raise RuntimeError(
            f"'{STDIN}' reads the name of an interface from a pipe, but standard input is a "
            f'terminal. Write: echo std_msgs/msg/String | ros2 interface show {STDIN}'
        )
    name = sys.stdin.readline().strip()
    if not name:
        raise RuntimeError('Standard input has no interface name in its first line')
    return name
