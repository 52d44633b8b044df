# SPDX-License-Identifier: Apache-2.0
"""A launch test file with ROS nodes, as pytest sees it."""

from __future__ import annotations

from launch_testing.pytest.launch_test_module import LaunchTestItem, LaunchTestModule
from launch_testing_ros._domain import isolated_domain


class LaunchRosTestItem(LaunchTestItem):
    """The run of all tests of a file on a launch description, in a domain of its own."""

    def runtest(self) -> None:
        """Launch the description and run the tests."""
        with isolated_domain():
            super().runtest()


class LaunchRosTestModule(LaunchTestModule):
    """A file that holds a launch test if its function has the marker."""

    marker = 'rostest'
    item_class = LaunchRosTestItem
