# SPDX-License-Identifier: Apache-2.0
"""Pytest hooks that collect launch test files of ROS nodes, each in its own domain."""

from __future__ import annotations

from pathlib import Path
from typing import Optional, TYPE_CHECKING

from launch_testing.pytest.hooks import mentions
import pytest

if TYPE_CHECKING:
    from launch_testing_ros.pytest.launch_ros_test_module import LaunchRosTestModule

_MARKER = 'rostest'


def pytest_configure(config: pytest.Config) -> None:
    """
    Register the marker `rostest`.

    Parameters
    ----------
    config
        The configuration of the pytest run.

    """
    config.addinivalue_line(
        'markers', f'{_MARKER}: like launch_test, but in a ROS domain of its own'
    )


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makemodule(
    module_path: Path,
    parent: pytest.Collector,
) -> Optional[LaunchRosTestModule]:
    """
    Collect a file as a launch test if it mentions the marker.

    Parameters
    ----------
    module_path
        The file.
    parent
        The collector of its directory.

    Returns
    -------
    LaunchRosTestModule or None
        None leaves the file to other plugins.

    """
    if not mentions(module_path, _MARKER):
        return None
    from launch_testing_ros.pytest.launch_ros_test_module import LaunchRosTestModule

    module: LaunchRosTestModule = LaunchRosTestModule.from_parent(parent, path=module_path)
    return module
