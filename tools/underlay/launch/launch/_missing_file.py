# SPDX-License-Identifier: Apache-2.0
"""Say that a file does not exist, and which one was meant perhaps."""

from __future__ import annotations

from collections.abc import Container
import os

from launch._did_you_mean import did_you_mean

_LISTED = 12


_RELATIVE = (
    "A relative path is looked up from the current folder, '{folder}'. Beside this launch file "
    'is $(dirname)/..., or ThisLaunchFileDir() in Python; in a package it is '
    '$(find-pkg-share PACKAGE)/..., or FindPackageShare().'
)


def explain_missing_include(path: str, reading: Container[str]) -> str:
    """
    Explain that an included launch file does not exist.

    Parameters
    ----------
    path
        The path of the file, as it was asked for.
    reading
        The absolute paths of the launch files being read, which are not suggested.

    Returns
    -------
    str
        The lines of the message; for a relative path they say where it is looked up.

    """
    text = explain_missing_file('launch file', path, reading)
    relative = '' if os.path.isabs(path) else _RELATIVE.format(folder=os.getcwd())
    return '\n'.join(filter(None, [text, relative]))


def explain_missing_file(what: str, path: str, but: Container[str] = ()) -> str:
    """
    Explain that a file does not exist, and suggest which one is meant.

    Parameters
    ----------
    what
        What the file is, such as `launch file`.
    path
        The path of the file, as it was asked for.
    but
        The absolute paths of files that are not suggested.

    Returns
    -------
    str
        The lines of the message: the closest name or what is in the folder, and whether the source
        of an installed package has the file.

    """
    return '\n'.join(filter(None, [_sentence(what, path, but), _source_of(path)]))


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
    there = os.listdir(above) if os.path.isdir(above) else []
    hint = '' if name in there else did_you_mean(name, there)
    return f'. {hint}' if hint else ''


def _source_of(path: str) -> str:
    """Say what to do if an installed package has the file in its source only."""
    try:
        from ros_environment.workspace import explain_uninstalled_file
    except ModuleNotFoundError:
        return ''
    return explain_uninstalled_file(path)


def _listing(names: list[str]) -> str:
    """Return what is in a folder, unless that is too much to be of help."""
    if not names or len(names) > _LISTED:
        return ''
    return f'In this folder there are: {", ".join(names)}'
