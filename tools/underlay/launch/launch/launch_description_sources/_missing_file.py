# SPDX-License-Identifier: Apache-2.0
"""What is said about launch files that do not exist."""

from __future__ import annotations

import os

from launch._did_you_mean import did_you_mean


def missing_file(path: str) -> str:
    """Say that a launch file does not exist, and which one in its folder comes closest."""
    folder, name = os.path.split(path)
    there = os.listdir(folder or '.') if os.path.isdir(folder or '.') else []
    text = f"the launch file '{path}' does not exist"
    return '. '.join(filter(None, [text, did_you_mean(name, there)]))
