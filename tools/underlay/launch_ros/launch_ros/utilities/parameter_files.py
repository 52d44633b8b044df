# SPDX-License-Identifier: Apache-2.0
"""Write parameters to files that nodes can read."""

from __future__ import annotations

import atexit
from collections.abc import Mapping
import os
import tempfile
from typing import Any

from launch_ros.utilities.yaml_text import parameter_file_text

_written: list[str] = []


def write_parameter_file(node_name: str, parameters: Mapping[str, Any]) -> str:
    """Write a file, which is removed when this process ends, and return its path."""
    if not _written:
        atexit.register(_remove_all)
    descriptor, path = tempfile.mkstemp(prefix='launch_params_', text=True)
    _written.append(path)
    with open(descriptor, 'w', encoding='utf-8') as file:
        file.write(parameter_file_text(node_name, parameters))
    return path


def is_written_here(path: str) -> bool:
    """Return whether a file is one of those that were written here."""
    return path in _written


def _remove_all() -> None:
    for path in _written:
        try:
            os.unlink(path)
        except OSError:
            pass  # someone has removed it already
    _written.clear()
