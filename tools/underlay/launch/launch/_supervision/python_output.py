# SPDX-License-Identifier: Apache-2.0
"""Detect commands that run Python, whose output is delayed unless it is unbuffered."""

from __future__ import annotations

from collections.abc import Sequence
import os

from launch._programs import find_program

ROS_ARGUMENTS = '--ros-args'  # what follows is for a node; none of it is a program


def runs_python(command: Sequence[str], *, shell: bool) -> bool:
    """
    Whether one of the words of a command is a Python interpreter, or a script for one.

    Parameters
    ----------
    command
        The words; what follows `--ros-args` is left out.
    shell
        Whether a shell runs the command, and therefore splits the words at spaces.

    """
    words = ' '.join(command).split() if shell else command
    if ROS_ARGUMENTS in words:
        words = words[: words.index(ROS_ARGUMENTS)]
    return any(_is_python(word) for word in words if word and not word.startswith('-'))


def _is_python(word: str) -> bool:
    if os.path.basename(word).startswith('python'):
        return True
    path = word if '/' in word else find_program(word)
    return path is not None and b'python' in _interpreter(path)


def _interpreter(path: str) -> bytes:
    """Return the shebang of a script, empty for any other file."""
    try:
        if not os.path.isfile(path):
            return b''
        with open(path, 'rb') as file:
            head = file.read(256)
    except (OSError, ValueError):
        return b''
    return head.partition(b'\n')[0] if head.startswith(b'#!') else b''
