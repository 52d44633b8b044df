# SPDX-License-Identifier: Apache-2.0
"""Extensions of launch_testing for ROS nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_testing_ros import tools
    from launch_testing_ros.data_republisher import DataRepublisher
    from launch_testing_ros.message_pump import MessagePump
    from launch_testing_ros.test_runner import LaunchTestRunner
    from launch_testing_ros.wait_for_topics import WaitForTopics

__all__ = ['DataRepublisher', 'LaunchTestRunner', 'MessagePump', 'WaitForTopics', 'tools']

__getattr__, __dir__ = lazy_exports(
    __name__, __all__, {'LaunchTestRunner': 'test_runner', 'tools': ''}
)
