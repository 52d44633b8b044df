# SPDX-License-Identifier: Apache-2.0
"""Explain that a file does not exist, and suggest a similar one."""

from __future__ import annotations

from collections.abc import Container
import os

from ros_environment.suggestions import did_you_mean
from ros_environment.workspace import explain_uninstalled_file

_LISTED = 12


def explain_missing_file(what: str, path: str, but: Container[str] = ()) -> str:
    """
    Explain that a file does not exist, and suggest a similar one.

    Parameters
    ----------
    what
        The kind of file, such as `launch file`.
    path
        The path of the file, as requested.
    but
        The absolute paths of files that are not suggested.

    Returns
    -------
    str
        The lines of the message: the closest name or the contents of the directory, and whether
        the source of an installed package has the file.

    """
    return '\n'.join(filter(None, [_sentence(what, path, but), explain_uninstalled_file(path)]))


def _sentence(what: str, path: str, but: Container[str]) -> str:
    unsuitable = _unsuitable(path)
    if unsuitable:
        return f"the {what} '{path}' is {unsuitable}"
    folder, name = os.path.split(path)
    text = f"the {what} '{path}' does not exist"
    if not os.path.isdir(folder or '.'):
        return f"{text}: there is no folder '{folder}'{_closest_folder(folder)}"
    there = sorted(
        each
        for each in os.listdir(folder or '.')
        if not each.startswith('.') and os.path.abspath(os.path.join(folder, each)) not in but
    )
    hint = did_you_mean(name, there) or _listing(there)
    return f'{text}. {hint}' if hint else text


def _unsuitable(path: str) -> str:
    """Describe what a path is instead of a regular file; empty if it does not exist."""
    if os.path.isdir(path):
        return 'a folder'
    if os.path.exists(path):
        return 'not a regular file'
    if os.path.islink(path):
        return f"a broken symbolic link to '{os.readlink(path)}'"
    return ''


def _closest_folder(folder: str) -> str:
    above, name = os.path.split(folder)
    there = os.listdir(above) if os.path.isdir(above) else []
    hint = '' if name in there else did_you_mean(name, there)
    return f'. {hint}' if hint else ''


def _listing(names: list[str]) -> str:
    """List the contents of a directory, unless there are too many entries."""
    if not names or len(names) > _LISTED:
        return ''
    return f'This folder contains: {", ".join(names)}'
