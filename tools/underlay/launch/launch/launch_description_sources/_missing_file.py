# SPDX-License-Identifier: Apache-2.0
"""What is said about launch files that do not exist."""

from __future__ import annotations

import os


def missing_file(path: str) -> str:
    """Say that a launch file does not exist, and which one in its folder comes closest."""
    import difflib

    folder, name = os.path.split(path)
    there = os.listdir(folder or '.') if os.path.isdir(folder or '.') else []
    close = difflib.get_close_matches(name, there, n=1)
    hint = f". Did you mean '{close[0]}'?" if close else ''
    return f"the launch file '{path}' does not exist{hint}"
