# SPDX-License-Identifier: Apache-2.0
"""How interfaces are written."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any


def command_line(interface: Any) -> str:
    """
    Format a command interface with whether it is available and claimed.

    Parameters
    ----------
    interface
        A `controller_manager_msgs/HardwareInterface`.

    """
    available = 'available' if interface.is_available else 'unavailable'
    claimed = 'claimed' if interface.is_claimed else 'unclaimed'
    return f'{interface.name} [{available}] [{claimed}]'


def print_lines(title: str, lines: Iterable[str], indent: str = '') -> None:
    """
    Print a title, and indented lines below it.

    Parameters
    ----------
    title
        The first line.
    lines
        What is below, one tab further to the right.
    indent
        What precedes each line.

    """
    print(f'{indent}{title}')
    for line in lines:
        print(f'{indent}\t{line}')
