# SPDX-License-Identifier: Apache-2.0
"""
Let a package be built whose setup.py lists data files that do not exist yet.

Beginners often write the `data_files` of a package before its launch files, at which setuptools
would stop with a traceback. `leave_out` is an extension that setuptools calls for each package.
"""

from __future__ import annotations

from collections.abc import Iterable
import os
import sys
from typing import Any

COMMANDS = {'develop', 'install'}


def leave_out(distribution: Any) -> None:
    """
    Remove the files that do not exist from the `data_files` of a distribution, and print them.

    Parameters
    ----------
    distribution
        The setuptools distribution; files are printed only while it is installed.

    """
    kept, missing = split(distribution.data_files or [])
    if not missing:
        return
    distribution.data_files = kept
    if COMMANDS & set(sys.argv):
        names = ', '.join(missing)
        print(
            'The data_files of setup.py list files that do not exist, so they are not installed: '
            f'{names}. Create them and build again, or remove them from setup.py.',
            file=sys.stderr,
        )


def split(data_files: Iterable[Any]) -> tuple[list[Any], list[str]]:
    """
    Separate data files that exist from those that do not.

    Parameters
    ----------
    data_files
        Files, or pairs of the folder to install to and a list of files.

    Returns
    -------
    tuple
        The elements with the files that exist, and the names of those that do not.

    """
    kept: list[Any] = []
    missing: list[str] = []
    for element in data_files:
        files = [element] if isinstance(element, str) else list(element[1])
        absent = [name for name in files if not os.path.exists(name)]
        missing += absent
        present = [name for name in files if name not in absent]
        if isinstance(element, str):
            kept += present
        else:
            kept.append((element[0], present))
    return kept, missing


leave_out.order = 100  # type: ignore[attr-defined]  # after the options of setuptools itself
