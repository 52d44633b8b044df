# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag convert`."""

from __future__ import annotations

import argparse

from ros2bag.api.play_arguments import add_input_argument, bag_paths
from ros2bag.verb import VerbExtension

EPILOG = """\
The file after -o lists the bags to write, each with its topics:

output_bags:
- uri: merged
  storage_id: mcap
  all_topics: true
  all_services: true
  compression_mode: file
  compression_format: zstd

Bags of ROS 1:
rosbags-convert --src OLD --dst NEW --dst-storage mcap"""


class ConvertVerb(VerbExtension):
    """Given input bags, write out new bags with different settings."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the bags to read, and the file that describes those to write.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_input_argument(parser)
        parser.add_argument(
            '--input-options',
            metavar='FILE',
            help='a YAML file with the bags to read, instead of -i',
        )
        parser.add_argument(
            '-o',
            '--output-options',
            required=True,
            metavar='FILE',
            help='a YAML file with the bags to write',
        )
        parser.epilog = EPILOG

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Write the bags, and print how many messages each has.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Returns
        -------
        int or str or None
            An error message if no bag is named, or in two ways.

        Raises
        ------
        BagError
            A bag cannot be read or written, or a file is malformed.

        """
        if bool(args.input) == bool(args.input_options):
            return 'Name the bags to read: with -i for each, or in a file with --input-options'
        from ament_index_python.packages import get_package_share_directory
        from ros2bag.api.converting import convert, read_inputs, read_outputs
        from ros2bag.storage.bags import Bags
        from ros2bag.storage.definitions import Definition, definition_of

        def find_definition(type_name: str) -> Definition:
            return definition_of(type_name, get_package_share_directory)

        outputs = read_outputs(args.output_options)
        bags = Bags(read_inputs(args.input_options) if args.input_options else bag_paths(args))
        bags.check()
        for folder, count in convert(bags, outputs, find_definition):
            print(f'{folder}: {count} messages')
        return None
