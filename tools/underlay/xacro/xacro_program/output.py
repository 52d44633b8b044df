# SPDX-License-Identifier: Apache-2.0
"""Write the output atomically."""

from __future__ import annotations

import os
import sys
from typing import Optional


def write_output(text: str, path: Optional[str]) -> None:
    """
    Write the output to a file, atomically, or to the standard output.

    Parameters
    ----------
    text
        The output.
    path
        The file, whose directory is created if needed; None for the standard output.

    Raises
    ------
    OSError
        The output cannot be written.

    """
    if path is None:
        sys.stdout.write(text)
        sys.stdout.flush()
    elif os.path.exists(path) and not os.path.isfile(path):
        _write(text, path)
    else:
        _replace(text, os.path.realpath(path))


def _replace(text: str, path: str) -> None:
    os.makedirs(os.path.dirname(path), exist_ok=True)
    new = f'{path}.{os.getpid()}.new'
    try:
        _write(text, new)
        if os.path.exists(path):
            os.chmod(new, os.stat(path).st_mode)
        os.replace(new, path)
    finally:
        if os.path.exists(new):
            os.unlink(new)


def _write(text: str, path: str) -> None:
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)
