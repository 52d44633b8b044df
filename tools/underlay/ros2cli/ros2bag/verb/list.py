# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag list`."""

from __future__ import annotations

import argparse

from ros2bag.verb import VerbExtension

KNOWN = {
    'storage': {
        'mcap': 'read and written, in the layout of rosbag2 (metadata.yaml version 9)',
        'sqlite3': 'only read',
    },
    'converter': {'cdr': 'messages are kept as they are sent'},
    'compressor': {'lz4': 'chunks of MCAP files', 'zstd': 'chunks of MCAP files'},
    'decompressor': {'lz4': 'chunks of MCAP files', 'zstd': 'chunks of MCAP files'},
}


class ListVerb(VerbExtension):
    """Print the supported formats."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the kind of format, such as `storage`.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        parser.add_argument('plugin_type', choices=list(KNOWN), help='what to list')
        parser.add_argument('-v', '--verbose', action='store_true', help='describe each of them')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the formats of one kind.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        """
        for name, purpose in KNOWN[args.plugin_type].items():
            print(f'{name}: {purpose}' if args.verbose else name)
        return None
