# SPDX-License-Identifier: Apache-2.0
"""Fast look-up of entry points that avoids `importlib.metadata` if there are none."""

from __future__ import annotations

from collections.abc import Iterator
import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint


def entry_points_of(group: str) -> list[EntryPoint]:
    """
    List the entry points of a group in all installed distributions.

    `importlib.metadata` is loaded only if there are any.

    Parameters
    ----------
    group
        The name of the group, such as `launch.frontend.parser`.

    """
    section = f'[{group}]'.encode()
    if not any(section in content for content in _contents()):
        return []
    from importlib.metadata import entry_points

    return list(entry_points(group=group))


def _contents() -> Iterator[bytes]:
    """Yield the contents of the entry point files on the module search path."""
    for folder in sys.path:
        try:
            names = os.listdir(folder or '.')
        except OSError:
            continue  # not a directory: an archive, or it does not exist
        for name in names:
            if name.endswith(('.dist-info', '.egg-info')):
                yield _content(os.path.join(folder, name, 'entry_points.txt'))


def _content(path: str) -> bytes:
    try:
        with open(path, 'rb') as file:
            return file.read()
    except OSError:
        return b''
