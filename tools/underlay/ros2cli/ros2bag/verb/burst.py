# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag burst`."""

from __future__ import annotations

import argparse

from ros2bag.api.play_arguments import (
    add_bags_arguments,
    add_choice_arguments,
    add_span_arguments,
    AS_FAST_AS_POSSIBLE,
)
from ros2bag.verb import VerbExtension
from ros2cli.arguments import positive_int


class BurstVerb(VerbExtension):
    """Publish a bag as fast as possible."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the bag, the choice of topics, the time span and the number of messages.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_bags_arguments(parser)
        add_choice_arguments(parser)
        add_span_arguments(parser)
        parser.add_argument(
            '-n',
            '--num-messages',
            type=positive_int,
            help='stop after this many messages (default: all)',
        )
        parser.set_defaults(**AS_FAST_AS_POSSIBLE)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Publish the messages of a bag without waiting between them.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        """
        from ros2bag.api.playing import play

        play(args)
        return None
