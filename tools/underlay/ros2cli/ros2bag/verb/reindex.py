# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag reindex`."""

from __future__ import annotations

import argparse

from ros2bag.api.play_arguments import add_bag_argument
from ros2bag.verb import VerbExtension


class ReindexVerb(VerbExtension):
    """Recreate the metadata of a bag from its files."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the bag.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_bag_argument(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Rewrite `metadata.yaml` from the indices of the files; see `recover` for files without one.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Raises
        ------
        BagError
            A file has no index, is damaged, or is still being recorded.

        """
        from ros2bag.storage.recovery import write_metadata

        count = write_metadata(args.bag_path)
        print(f'{args.bag_path}: {count} messages; metadata.yaml is written')
        return None
