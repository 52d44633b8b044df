# SPDX-License-Identifier: Apache-2.0
"""Import rclpy without what a command does not need of it."""

from __future__ import annotations

import os
import sys
from types import MethodType

from ros2cli.deferral import defer
from ros2cli.messages.lazy_packages import import_interfaces_when_used


def import_rclpy() -> None:
    """
    Import rclpy, unless it is there already.

    Its C library loads a hundred others. Python has each of their functions looked up at once;
    here that happens when one is first called, as for any program in C, and most never are. Of
    the messages that rclpy imports most are never used either.
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
    """Tell what `inspect.ismethod` does, which rclpy imports by its name."""
    return isinstance(candidate, MethodType)
