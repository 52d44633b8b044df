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
    """
    Choose the path of a new recording; nothing is created.

    Parameters
    ----------
    folder
        The folder of all recordings.
    name
        The name that a person gave it; if blank, it is made from the time.
    now
        The time for such a name.

    Raises
    ------
    ValueError
        The name is no file name, or there is such a recording already; the text is a sentence.

    """
    name = name.strip()
    if name.startswith('.') or '/' in name or '\0' in name:
        raise ValueError('The name of a recording has no slashes, and no dot before it.')
    if not name:
        return _free(os.path.join(folder, now.strftime('%Y-%m-%d_%H-%M-%S')))
    path = os.path.join(folder, name)
    if os.path.lexists(path):
        raise ValueError(f"There is a recording '{name}' already. Choose another name.")
    return path


def regex_of_robot(namespace: str) -> str:
    """
    Build the regular expression of the topics of one robot, and of those all robots share.

    Parameters
    ----------
    namespace
        The namespace of the robot without slashes at its ends.

    Returns
    -------
    str
        The expression; '' for no namespace, which stands for all topics.

    """
    return f'^/({re.escape(namespace)}/.+|{SHARED})$' if namespace else ''


def topics_in(text: str) -> list[str]:
    """
    Split a text into the topics it lists, each once.

    Parameters
    ----------
    text
        Names with blanks, line breaks or commas between them.

    """
    return list(dict.fromkeys(word for word in SEPARATOR.split(text) if word))


def _free(path: str) -> str:
    """Return a path at which there is nothing."""
    number, free = 1, path
    while os.path.lexists(free):
        number += 1
        free = f'{path}_{number}'
    return free
