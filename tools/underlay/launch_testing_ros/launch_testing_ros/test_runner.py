# SPDX-License-Identifier: Apache-2.0
"""Run the tests of a launch test file with ROS nodes."""

from __future__ import annotations

from launch_testing import test_runner

__all__ = ['LaunchTestRunner']


class LaunchTestRunner(test_runner.LaunchTestRunner):
    """Runner of launch tests with nodes; the same as that of `launch_testing`, which can do so."""
