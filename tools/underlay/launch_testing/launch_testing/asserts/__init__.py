# SPDX-License-Identifier: Apache-2.0
"""Assertions about the processes of a launch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch_testing.asserts.assert_exit_codes import (
        assertExitCodes,
        EXIT_FORCED,
        EXIT_OK,
        EXIT_SIGINT,
        EXIT_SIGKILL,
        EXIT_SIGQUIT,
        EXIT_SIGSEGV,
    )
    from launch_testing.asserts.assert_output import (
        assertInStderr,
        assertInStdout,
        assertInStream,
        assertSequentialStdout,
        SequentialTextChecker,
    )
    from launch_testing.util.resolve_processes import NO_CMD_ARGS

__all__ = [
    'EXIT_FORCED',
    'EXIT_OK',
    'EXIT_SIGINT',
    'EXIT_SIGKILL',
    'EXIT_SIGQUIT',
    'EXIT_SIGSEGV',
    'NO_CMD_ARGS',
    'SequentialTextChecker',
    'assertExitCodes',
    'assertInStderr',
    'assertInStdout',
    'assertInStream',
    'assertSequentialStdout',
]

# ROS 2 Jazzy has a module for it; tests import from that, too.
also_found_at(__name__, 'assert_sequential_output')

_ELSEWHERE = {
    'EXIT_FORCED': 'assert_exit_codes',
    'EXIT_OK': 'assert_exit_codes',
    'EXIT_SIGINT': 'assert_exit_codes',
    'EXIT_SIGKILL': 'assert_exit_codes',
    'EXIT_SIGQUIT': 'assert_exit_codes',
    'EXIT_SIGSEGV': 'assert_exit_codes',
    'NO_CMD_ARGS': 'assert_output',
    'SequentialTextChecker': 'assert_output',
    'assertExitCodes': 'assert_exit_codes',
    'assertInStderr': 'assert_output',
    'assertInStdout': 'assert_output',
    'assertInStream': 'assert_output',
    'assertSequentialStdout': 'assert_output',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
