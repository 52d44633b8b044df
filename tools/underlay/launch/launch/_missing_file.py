# SPDX-License-Identifier: Apache-2.0
"""Say that a file does not exist, and which one was meant perhaps."""

from __future__ import annotations

import os

from launch._did_you_mean import did_you_mean

_LISTED = 12


def explain_missing_file(what: str, path: str) -> str:
    """Return a sentence about a file, with the closest one in its folder or what is there."""
    unsuitable = _unsuitable(path)
    if unsuitable:
        return f"the {what} '{path}' is {unsuitable}"
    folder, name = os.path.split(path)
    text = f"the {what} '{path}' does not exist"
    if not os.path.isdir(folder or '.'):
        return f"{text}: there is no folder '{folder}'{_closest_folder(folder)}"
    there = sorted(each for each in os.listdir(folder or '.') if not each.startswith('.'))
    hint = did_you_mean(name, there) or _listing(there)
    return f'{text}. {hint}' if hint else text


def _unsuitable(path: str) -> str:
    """Return what there is under a path that is no file, empty if there is nothing."""
    if os.path.isdir(path):
        return 'a folder'
    if os.path.exists(path):
        return 'not a regular file'
    if os.path.islink(path):
        return f"a symbolic link that leads nowhere ('{os.readlink(path)}')"
    return ''


def _closest_folder(folder: str) -> str:
    above, name = os.path.split(folder)
    hint = did_you_mean(name, os.listdir(above)) if os.path.isdir(above) else ''
    return f'. {hint}' if hint else ''


def _listing(names: list[str]) -> str:
    """Return what is in a folder, unless that is too much to be of help."""
    if not names or len(names) > _LISTED:
        return ''
    return f'In this folder there are: {", ".join(names)}'
