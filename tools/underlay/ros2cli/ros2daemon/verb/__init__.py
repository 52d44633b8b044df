# SPDX-License-Identifier: Apache-2.0
"""The verbs of `ros2 daemon`, one a module."""

import argparse

from ros2cli.verb import VerbExtension

__all__ = ['AnswerVerb', 'VerbExtension']

ANSWER = (
    'The daemon is not running\n'
    'There is none, and none is needed: each command looks at the graph itself, as soon as the '
    'graph is complete'
)


class AnswerVerb(VerbExtension):
    """A verb that can only say that there is no daemon, and why nothing is lost."""

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print that there is no daemon, which is no error, so that scripts go on.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line, as for `VerbExtension.main`.

        """
        print(ANSWER)
        return None
