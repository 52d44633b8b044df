# SPDX-License-Identifier: Apache-2.0
"""Set up sys.stdin, sys.stdout and sys.stderr as Python does at startup."""

from __future__ import annotations

import io
import os
import sys
from typing import Any, TextIO

_NAMES = ('stdin', 'stdout', 'stderr')


def take_over(descriptors: tuple[int, int, int]) -> None:
    """
    Make three descriptors the standard input, output and error of this process.

    Parameters
    ----------
    descriptors
        The descriptors, in this order; they are closed.

    """
    for number, descriptor in enumerate(descriptors):
        os.dup2(descriptor, number)
        os.close(descriptor)
        _renew(number, _NAMES[number])


def _renew(number: int, name: str) -> None:
    """Replace a standard stream by one for its new file descriptor."""
    stream = _open(number, name, getattr(sys, name))
    setattr(sys, name, stream)
    setattr(sys, f'__{name}__', stream)


def _open(number: int, name: str, former: TextIO) -> TextIO:
    unbuffered = os.environ.get('PYTHONUNBUFFERED', '') != '' and not sys.flags.ignore_environment
    mode = 'w' if number else 'r'
    buffering = 0 if unbuffered and number else -1
    binary: Any = os.fdopen(number, f'{mode}b', buffering=buffering, closefd=False)
    raw = getattr(binary, 'raw', binary)
    raw.name = f'<{name}>'
    stream: Any = io.TextIOWrapper(
        binary,
        encoding=former.encoding,
        errors=former.errors,
        newline='\n',
        line_buffering=not unbuffered and (number == 2 or raw.isatty()),
        write_through=unbuffered,
    )
    stream.mode = mode
    renewed: TextIO = stream
    return renewed
