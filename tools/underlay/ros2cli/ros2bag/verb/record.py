# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag record`."""

from __future__ import annotations

import argparse

from ros2bag.api.record_arguments import add_record_arguments, usage_error
from ros2bag.verb import VerbExtension


class RecordVerb(VerbExtension):
    """Record ROS data to a bag."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the choice of topics, the output and the way of recording."""
        add_record_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Record until the user stops it."""
        error = usage_error(args)
        if error:
            return error
        from ros2bag.api.recording import record

        record(args)
        return None
