# SPDX-License-Identifier: Apache-2.0
"""Pytest collector and items of launch test files of ROS nodes."""

from __future__ import annotations

from launch_testing.pytest.launch_test_module import LaunchTestItem, LaunchTestModule
from launch_testing_ros._domain import isolated_domain


class LaunchRosTestItem(LaunchTestItem):
    """Pytest item that runs all tests of a file on a launch description, in its own domain."""

    def runtest(self) -> None:
        """Launch the description and run the tests in an isolated domain."""
        with isolated_domain():
            super().runtest()


class LaunchRosTestModule(LaunchTestModule):
    """Test module that contains a launch test if its function has the marker."""

    marker = 'rostest'
    item_class = LaunchRosTestItem
