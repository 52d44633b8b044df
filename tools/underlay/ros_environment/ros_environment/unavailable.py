# SPDX-License-Identifier: Apache-2.0
"""Packages of ROS 2 that this environment cannot have, and what to do without them."""

from __future__ import annotations

_ADVICE = {
    'rclcpp_components': (
        "'rclcpp_components' has no wheel on PyPI, so this environment has no container for "
        'components in C++. Build rclcpp_components from source in this workspace, or run this '
        'launch file where ROS 2 Jazzy is installed as a whole. If the package of a component '
        'also installs it as an executable of its own, a Node action runs it without a container.'
    ),
}


def explain_unavailable(package: str) -> str:
    """Say what to do without a package, or return '' when there is nothing to say."""
    return _ADVICE.get(package, '')
