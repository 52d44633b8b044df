# SPDX-License-Identifier: Apache-2.0
"""The argument parser of all commands."""

from __future__ import annotations

import argparse
import sys
from typing import Any


class CommandParser(argparse.ArgumentParser):
    """A parser whose help is output like any other; argparse hides that it cannot be written."""

    def print_help(self, file: Any = None) -> None:
        """Print the help to a file, by default to stdout."""
        print(self.format_help(), end='', file=file or sys.stdout)
