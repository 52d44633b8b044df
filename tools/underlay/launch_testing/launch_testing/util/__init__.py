# SPDX-License-Identifier: Apache-2.0
"""Utilities for launch tests."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_testing.util.keep_alive_proc import KeepAliveProc
    from launch_testing.util.resolve_processes import (
        NO_CMD_ARGS,
        NoMatchingProcessException,
        resolveProcesses,
    )

__all__ = [
    'NO_CMD_ARGS',
    'KeepAliveProc',
    'NoMatchingProcessException',
    'resolveProcesses',
]

_ELSEWHERE = {
    'NO_CMD_ARGS': 'resolve_processes',
    'NoMatchingProcessException': 'resolve_processes',
    'resolveProcesses': 'resolve_processes',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
