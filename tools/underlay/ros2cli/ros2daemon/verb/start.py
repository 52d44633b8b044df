# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 daemon start`."""

from __future__ import annotations

import argparse

from ros2daemon.verb import AnswerVerb


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
