# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 component standalone`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import add_strategy_arguments, node_name
from ros2component.verb import VerbExtension
from ros2component.verb.load import add_load_arguments

DEFAULT_CONTAINER_NAME = 'standalone_container'


class StandaloneVerb(VerbExtension):
    """Run a component into its own standalone container node."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the container's name and what to load into it.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            '-c',
            '--container-node-name',
            type=node_name,
            default=DEFAULT_CONTAINER_NAME,
            help='Name of the container node to be created (default: %(default)s)',
        )
        add_load_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Start a container, load a component into it, and wait until the container exits.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Returns
        -------
        int or str or None
            The exit status of the container.

        """
        from ros2component.standalone import run_standalone

        return run_standalone(args)
