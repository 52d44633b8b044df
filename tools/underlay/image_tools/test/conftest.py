# SPDX-License-Identifier: Apache-2.0
"""The fixtures: a domain, and ROS in it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import sys

import pytest
import rclpy

sys.path.insert(0, str(Path(__file__).parents[2] / 'robot_state_publisher/test'))

from publisher_fixtures import domain  # noqa: E402

__all__ = ['domain']


@pytest.fixture
def ros(domain: int) -> Iterator[None]:
    """Initialise ROS in a domain of its own."""
    rclpy.init(domain_id=domain)
    yield
    rclpy.try_shutdown()
