# SPDX-License-Identifier: Apache-2.0
"""Names and topic filters of recordings."""

from __future__ import annotations

from datetime import datetime
import os
import re

__all__ = ['bag_folder', 'regex_of_robot', 'topics_in']

SHARED = 'tf|tf_static|clock'
SEPARATOR = re.compile(r'[\s,]+')


def bag_folder(folder: str, name: str, now: datetime) -> str:
    """
    Choose the path of a new recording; nothing is created.

    Parameters
    ----------
    folder
        The folder of all recordings.
    name
        The name given by the user; if blank, it is derived from the time.
    now
        The time used for such a name.

    Raises
    ------
    ValueError
        The name is not a valid file name, or the recording already exists; the message is a full
        sentence.

    """
    name = name.strip()
    if name.startswith('.') or '/' in name or '\0' in name:
        raise ValueError(
            f"The name of a recording has no slashes, and no dot before it: '{name}' will not do."
        )
    if not name:
        return _free(os.path.join(folder, now.strftime('%Y-%m-%d_%H-%M-%S')))
    path = os.path.join(folder, name)
    if os.path.lexists(path):
        raise ValueError(f"There is a recording '{name}' already. Choose another name.")
    return path


def regex_of_robot(namespace: str) -> str:
    """
    Build the regular expression for the topics of one robot and the topics shared by all robots.

    Parameters
    ----------
    namespace
        The namespace of the robot, without leading and trailing slashes.

    Returns
    -------
    str
        The expression; '' for no namespace, which means all topics.

    """
    return f'^/({re.escape(namespace)}/.+|{SHARED})$' if namespace else ''


def topics_in(text: str) -> list[str]:
    """
    Split a text into the topics that it lists, without duplicates.

    Parameters
    ----------
    text
        Names separated by spaces, line breaks or commas.

    """
    return list(dict.fromkeys(word for word in SEPARATOR.split(text) if word))


def _free(path: str) -> str:
    """Return a path that does not exist yet."""
    number, free = 1, path
    while os.path.lexists(free):
        number += 1
        free = f'{path}_{number}'
    return free
