# SPDX-License-Identifier: Apache-2.0
"""Files of parameters: those that there are, and those that are written for nodes."""

from __future__ import annotations

import atexit
from collections.abc import Mapping
import os
from typing import Any

from launch.logging import get_logger
from launch_ros.utilities.yaml_text import parameter_file_text

_written: list[str] = []


def is_parameter_file(path: str) -> bool:
    """Return whether there is a file; if not, log it in the known words and what may help."""
    if os.path.isfile(path):
        return True
    from launch._missing_file import explain_missing_file

    logger = get_logger('launch_ros.actions.node')
    logger.warning('Parameter file path is not a file: %s', path)
    advice = explain_missing_file('file', path)
    logger.warning('The node gets no parameters from it, because %s', advice)
    return False


def write_parameter_file(node_name: str, parameters: Mapping[str, Any]) -> str:
    """Write the parameters of the nodes of a name to a file, and return its path."""
    return write_text(parameter_file_text(node_name, parameters))


def write_text(text: str) -> str:
    """Write a file, which is removed when this process ends, and return its path."""
    if not _written:
        atexit.register(_remove_all)
    import tempfile

    descriptor, path = tempfile.mkstemp(prefix='launch_params_', text=True)
    _written.append(path)
    with open(descriptor, 'w', encoding='utf-8') as file:
        file.write(text)
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
