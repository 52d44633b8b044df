# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag burst`."""

from __future__ import annotations

import argparse

from ros2bag.api.play_arguments import (
    add_bag_argument,
    add_choice_arguments,
    add_span_arguments,
    AS_FAST_AS_POSSIBLE,
)
from ros2bag.verb import VerbExtension
from ros2cli.argument_types import positive_int


class BurstVerb(VerbExtension):
    """Publish a bag as fast as possible."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the bag, the choice of topics and how much of it is published."""
        add_bag_argument(parser)
        add_choice_arguments(parser)
        add_span_arguments(parser)
        parser.add_argument(
            '-n',
            '--num-messages',
            type=positive_int,
            help='end after so many messages (default: all)',
        )
        parser.set_defaults(**AS_FAST_AS_POSSIBLE)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Publish the messages without waiting."""
        from ros2bag.api.playing import play

        play(args)
        return None
