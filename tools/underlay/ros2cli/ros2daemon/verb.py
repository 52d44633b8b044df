# SPDX-License-Identifier: Apache-2.0
"""The verbs of `ros2 daemon`, which can only say that there is no daemon."""

from __future__ import annotations

import argparse

from ros2cli.verb import VerbExtension

__all__ = ['AnswerVerb', 'VerbExtension']

ANSWER = (
    'The daemon is not running\n'
    'There is none, and none is needed: each command discovers the graph itself, and answers '
    'as soon as it is complete'
)


class AnswerVerb(VerbExtension):
    """A verb that can only say that there is no daemon, and why nothing is lost."""

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print that there is no daemon; this is not an error, so that scripts continue.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        """
        print(ANSWER)
        return None


class StartVerb(AnswerVerb):
    """Start the daemon if it is not running."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the option `--debug`, which has no effect.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        parser.add_argument(
            '-d', '--debug', action='store_true', help='accepted for compatibility'
        )


class StatusVerb(AnswerVerb):
    """Output the status of the daemon."""


class StopVerb(AnswerVerb):
    """Stop the daemon if it is running."""
