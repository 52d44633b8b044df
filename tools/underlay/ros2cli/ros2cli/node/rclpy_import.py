# SPDX-License-Identifier: Apache-2.0
"""Import rclpy without the parts that a command does not need."""

from __future__ import annotations

import os
import sys
from types import MethodType

from ros2cli.deferral import defer
from ros2cli.messages.lazy_packages import import_interfaces_when_used


def import_rclpy() -> None:
    """
    Import rclpy, unless it is imported already.

    Its C library loads a hundred others. By default Python resolves all their symbols at once
    (RTLD_NOW); here each is bound on first call, as in any C program, and most never are. Most
    of the messages that rclpy imports are never used either.
    """
    if 'rclpy' in sys.modules:
        return
    defer('inspect', ismethod=_is_method)
    defer('linecache', 'pathlib', 'textwrap')
    import_interfaces_when_used()
    flags = sys.getdlopenflags()
    sys.setdlopenflags(os.RTLD_LAZY)
    try:
        import rclpy.impl.implementation_singleton
    finally:
        sys.setdlopenflags(flags)
    assert rclpy


def _is_method(candidate: object) -> bool:
    """Stand in for `inspect.ismethod`, which rclpy imports by its name."""
    return isinstance(candidate, MethodType)
