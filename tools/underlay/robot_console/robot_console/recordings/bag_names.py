# SPDX-License-Identifier: Apache-2.0
"""Names of recordings, and which topics a recording of one robot has."""

from __future__ import annotations

from datetime import datetime
import os
import re

__all__ = ['bag_folder', 'regex_of_robot', 'topics_in']

SHARED = 'tf|tf_static|clock'
SEPARATOR = re.compile(r'[\s,]+')


def bag_folder(folder: str, name: str, now: datetime) -> str:
    """Return the folder of a new recording, or raise ValueError with the reason."""
    name = name.strip()
    if name in ('.', '..') or '/' in name or '\0' in name:
        raise ValueError(f"The name of a recording has no slashes, and is not '{name}'.")
    if not name:
        return _free(os.path.join(folder, now.strftime('%Y-%m-%d_%H-%M-%S')))
    path = os.path.join(folder, name)
    if os.path.lexists(path):
        raise ValueError(f"There is a recording '{name}' already. Choose another name.")
    return path


def regex_of_robot(namespace: str) -> str:
    """Return what finds the topics of the robot of a namespace, and what all robots share."""
    return f'^/({re.escape(namespace)}/.+|{SHARED})$' if namespace else ''


def topics_in(text: str) -> list[str]:
    """Return the topics that a person has named, each once."""
    return list(dict.fromkeys(word for word in SEPARATOR.split(text) if word))


def _free(path: str) -> str:
    """Return a path at which there is nothing."""
    number, free = 1, path
    while os.path.lexists(free):
        number += 1
        free = f'{path}_{number}'
    return free
