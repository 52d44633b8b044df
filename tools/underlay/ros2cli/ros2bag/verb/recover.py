# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag recover`."""

from __future__ import annotations

import argparse

from ros2bag.verb import VerbExtension


class RecoverVerb(VerbExtension):
    """Make a broken or unfinished bag readable."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the folder of the bag.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        parser.add_argument(
            'bag_path', help='the folder of the bag; broken files are kept under another name'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Salvage the messages of broken files, and rewrite `metadata.yaml`.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        """
        from ros2bag.api.recovering import recover_and_report

        recover_and_report(args.bag_path)
        return None
