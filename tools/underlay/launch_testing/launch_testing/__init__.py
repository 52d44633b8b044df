# SPDX-License-Identifier: Apache-2.0
"""Integration tests of launch descriptions: tests on running processes and after shutdown."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_testing import actions, asserts, event_handlers, legacy, markers, tools, util
    from launch_testing.io_handler import ActiveIoHandler, IoHandler
    from launch_testing.launch_test_service import LaunchTestService
    from launch_testing.markers import parametrize, post_shutdown_test
    from launch_testing.proc_info_handler import ActiveProcInfoHandler, ProcInfoHandler
    from launch_testing.test_result import TestResult
    from launch_testing.test_runner import LaunchTestRunner

__all__ = [
    'ActiveIoHandler',
    'ActiveProcInfoHandler',
    'IoHandler',
    'LaunchTestRunner',
    'LaunchTestService',
    'ProcInfoHandler',
    'TestResult',
    'actions',
    'asserts',
    'event_handlers',
    'legacy',
    'markers',
    'parametrize',
    'post_shutdown_test',
    'tools',
    'util',
]

_ELSEWHERE = {
    'ActiveIoHandler': 'io_handler',
    'ActiveProcInfoHandler': 'proc_info_handler',
    'LaunchTestRunner': 'test_runner',
    'actions': '',
    'asserts': '',
    'event_handlers': '',
    'legacy': '',
    'markers': '',
    'parametrize': 'markers',
    'post_shutdown_test': 'markers',
    'tools': '',
    'util': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
