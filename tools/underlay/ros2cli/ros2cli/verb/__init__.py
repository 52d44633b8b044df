# SPDX-License-Identifier: Apache-2.0
"""The base class of all verbs."""

from __future__ import annotations

import argparse


class VerbExtension:
    """A verb of a command; the first line of a subclass's docstring is its help."""

    NAME: str | None = None
    EXTENSION_POINT_VERSION = '0.1'

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the verb's own arguments to its parser."""

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Do the work; an int is the exit status, a str is an error text."""
        raise NotImplementedError(f'{type(self).__name__} does not implement main()')
