# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 pkg list`."""

from __future__ import annotations

import argparse

from ros2pkg.api import get_package_names
from ros2pkg.verb import VerbExtension


class ListVerb(VerbExtension):
    """Output a list of available packages."""

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the names of all packages, one per line.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        names = get_package_names()
        if names:
            print('\n'.join(names))
        return None
