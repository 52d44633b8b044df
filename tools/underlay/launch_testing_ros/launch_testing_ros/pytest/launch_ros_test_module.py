# SPDX-License-Identifier: Apache-2.0
"""Pytest collector and items of launch test files of ROS nodes, each in its own domain."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import os

from launch_testing.pytest.launch_test_module import LaunchTestItem, LaunchTestModule

_DISABLED = 'DISABLE_ROS_ISOLATION'
_NAMES = ('ROS_DOMAIN_ID', 'ROS_AUTOMATIC_DISCOVERY_RANGE')
_SERVER = 'ROS_DISCOVERY_SERVER'  # which brings nodes of all domains together


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


@contextmanager
def isolated_domain() -> Iterator[None]:
    """Use a ROS domain that is unique on this machine and invisible to other machines."""
    if _DISABLED in os.environ:
        yield
        return
    from domain_coordinator import domain_id

    before = {name: os.environ.pop(name, None) for name in (*_NAMES, _SERVER)}
    try:
        with domain_id() as domain:
            os.environ.update(zip(_NAMES, (str(domain), 'LOCALHOST')))
            yield
    finally:
        for name, value in before.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value
