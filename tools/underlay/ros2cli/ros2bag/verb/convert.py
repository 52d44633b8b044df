# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag convert`."""

from __future__ import annotations

import argparse

from ros2bag.verb import VerbExtension

ADVICE = (
    'This command does not convert bags itself. Use rosbags-convert, which is installed as well '
    'and converts between ROS 1, sqlite3 and MCAP:\n  '
    'rosbags-convert --src OLD --dst NEW --dst-storage mcap'
)


class ConvertVerb(VerbExtension):
    """Show how to convert a bag to another format."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the options of rosbag2, so that they are accepted.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        parser.add_argument('-i', '--input', nargs='+', action='append', help='the bags')
        parser.add_argument('-o', '--output-options', help='the file with options')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Suggest the program that converts bags.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Returns
        -------
        int or str or None
            The advice, as an error message.

        """
        return ADVICE
