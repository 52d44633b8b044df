# SPDX-License-Identifier: Apache-2.0
"""The base class of all verbs."""

from __future__ import annotations

import argparse


class VerbExtension:
    """A verb of a command; the first line of a subclass's docstring is its help."""

    NAME: str | None = None
    EXTENSION_POINT_VERSION = '0.1'

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the verb's own arguments to its parser.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 bag play`.

        """

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Execute the verb.

        A RuntimeError, like a returned str, is printed on stderr and results in status 1.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line, with the arguments that `add_arguments` adds.

        Returns
        -------
        int or str or None
            The exit status, or an error message for stderr with status 1; None is status 0.

        Raises
        ------
        NotImplementedError
            The subclass does not override it.

        """
        raise NotImplementedError(f'{type(self).__name__} does not implement main()')
