# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag info`."""

from __future__ import annotations

import argparse
import sys

from ros2bag.api.play_arguments import add_bag_argument
from ros2bag.verb import VerbExtension


class InfoVerb(VerbExtension):
    """Print information about a bag."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the bag and the options for details.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_bag_argument(parser)
        parser.add_argument(
            '-t', '--topic-name', action='store_true', help='print only the names of the topics'
        )
        parser.add_argument(
            '-v',
            '--verbose',
            action='store_true',
            help='print for each topic its average rate, type hash and quality of service as well',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the metadata of a bag, and warn of files that are missing.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        """
        from ros2bag.api.info import info_text, topic_names_text
        from ros2bag.storage.bag_reader import BagReader

        reader = BagReader(args.bag_path)
        for path in reader.missing_paths:
            print(f"WARNING: the file '{path}' of the recording is missing", file=sys.stderr)
        print(
            topic_names_text(reader)
            if args.topic_name
            else info_text(reader, verbose=args.verbose)
        )
        return None
