# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag reindex`."""

from __future__ import annotations

import argparse

from ros2bag.api.play_arguments import add_bag_argument
from ros2bag.verb import VerbExtension


class ReindexVerb(VerbExtension):
    """Write the metadata of a bag anew from its files."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the bag."""
        add_bag_argument(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Write `metadata.yaml`; a file without an index is an error, see `recover`."""
        from ros2bag.storage.recovery import write_metadata

        count = write_metadata(args.bag_path)
        print(f'{args.bag_path}: {count} messages; metadata.yaml is written')
        return None
