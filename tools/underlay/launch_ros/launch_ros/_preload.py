# SPDX-License-Identifier: Apache-2.0
"""What nodes written in Python import: it is imported once for all of them."""

from __future__ import annotations

from collections.abc import Sequence

from launch_ros._tracing import Tracing

EARLY_VARIABLES = frozenset(
    ('RCL_ASSERT_RMW_ID_MATCHES', 'RMW_IMPLEMENTATION', 'ROS_PYTHON_CHECK_FIELDS')
)
"""What is read when rclpy and messages are imported, not only when a node is created."""

_tracing = Tracing()


def preload(scripts: Sequence[str]) -> None:
    """Import what the nodes behind some scripts need; nothing of it is initialised."""
    import rclpy
    import rclpy.executors
    import rclpy.node

    rclpy.get_rmw_implementation_identifier()


def before_fork() -> None:
    """Make libraries ready for copies of the process."""
    _tracing.before_fork()


def after_fork() -> None:
    """Make libraries work in a copy of the process."""
    _tracing.after_fork()
