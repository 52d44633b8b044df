# SPDX-License-Identifier: Apache-2.0
"""Advice on failed command lines that were joined from several strings."""

from __future__ import annotations

from collections.abc import Sequence
import os
import shlex
import shutil


def advice_on_failure(parts: Sequence[str], said: str) -> str:
    """
    Advise on a failed command: a path split at a space, or one that does not exist.

    Parameters
    ----------
    parts
        The strings that were joined into the command line.
    said
        The error output of the command; advice that it already contains is not repeated.

    Returns
    -------
    str
        A line break and the advice, or '' if there is none.

    """
    return _split_path(parts) or _missing_path(''.join(parts), said)


def advice_on_program(parts: Sequence[str]) -> str:
    """
    Advise on a program that was not found because of a missing space after its name.

    Parameters
    ----------
    parts
        The strings that were joined into the command line.

    Returns
    -------
    str
        A line break and the advice, or '' if there is none.

    """
    first = parts[0].split()
    if len(parts) < 2 or not first or parts[0][-1].isspace() or shutil.which(first[-1]) is None:
        return ''
    return (
        f"\nIs there a blank missing after '{parts[0]}'? The parts of a command are joined as "
        f"they are: Command(['{parts[0]} ', ...])"
    )


def _split_path(parts: Sequence[str]) -> str:
    """Return advice on a path that was split into several words at a space."""
    words = shlex.split(''.join(parts))
    for part in parts[1:]:
        is_path = os.path.isabs(part) and len(part.split()) > 1
        if is_path and not any(part in word for word in words):
            return (
                f"\nThe path '{part}' has a space in it, and became several words. Quote it: "
                f"Command(['{parts[0].rstrip()} \"', path, '\"'])"
            )
    return ''


def _missing_path(command: str, said: str) -> str:
    """Return advice on the first path that does not exist."""
    from launch._missing_file import explain_missing_file

    for word in shlex.split(command)[1:]:
        if word.startswith('/') and not os.path.exists(word):
            explanation = explain_missing_file('file', word)
            return '' if explanation in said else f'\n{explanation}'
    return ''
