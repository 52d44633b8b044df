# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag play`."""

from __future__ import annotations

import argparse

from ros2bag.api.play_arguments import (
    add_bags_arguments,
    add_choice_arguments,
    add_play_arguments,
    add_span_arguments,
)
from ros2bag.verb import VerbExtension


class PlayVerb(VerbExtension):
    """Play back ROS data from a bag."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the bag, the choice of topics, the time span and the playback options.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_bags_arguments(parser)
        add_choice_arguments(parser)
        add_play_arguments(parser)
        add_span_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Publish the messages of a bag with the timing of the recording.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        """
        from ros2bag.api.playing import play

        play(args)
        return None
