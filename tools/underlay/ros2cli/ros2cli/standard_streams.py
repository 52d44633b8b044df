# SPDX-License-Identifier: Apache-2.0
"""Handling of standard streams that the caller has closed, as in `ros2 topic list >&-`."""

from __future__ import annotations

import os
import sys

NAMES = ('stdin', 'stdout', 'stderr')


def open_standard_streams() -> None:
    """
    Open closed standard streams on /dev/null.

    Otherwise the next file or socket would get the descriptor, and receive the output.
    """
    for descriptor, name in enumerate(NAMES):
        if getattr(sys, name) is None and not _is_open(descriptor):
            os.open(os.devnull, os.O_RDWR)  # the lowest free descriptor: this one
            setattr(sys, name, os.fdopen(descriptor, 'r' if descriptor == 0 else 'w'))


def _is_open(descriptor: int) -> bool:
    try:
        os.fstat(descriptor)
    except OSError:
        return False
    return True
