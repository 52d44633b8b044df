# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag record`."""

from __future__ import annotations

import argparse

from ros2bag.api.record_arguments import add_record_arguments, usage_error
from ros2bag.verb import VerbExtension


class RecordVerb(VerbExtension):
    """Record ROS data to a bag."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the choice of topics, the output and the recording options.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_record_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Record topics until a signal arrives.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Returns
        -------
        int or str or None
            An error message if the options contradict each other or choose nothing.

        """
        error = usage_error(args)
        if error:
            return error
        from ros2bag.api.recording import record

        record(args)
        return None
