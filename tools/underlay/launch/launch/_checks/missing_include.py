# SPDX-License-Identifier: Apache-2.0
"""Error message for a missing launch file that another one includes."""

from __future__ import annotations

from collections.abc import Container
import os

from ros_environment.missing_file import explain_missing_file

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
        The path of the file, as requested.
    reading
        The absolute paths of the launch files being read, which are not suggested.

    Returns
    -------
    str
        The lines of the message; for a relative path they state where it is looked up.

    """
    text = explain_missing_file('launch file', path, reading)
    relative = '' if os.path.isabs(path) else _RELATIVE.format(folder=os.getcwd())
    return '\n'.join(filter(None, [text, relative]))
