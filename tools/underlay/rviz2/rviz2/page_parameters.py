# SPDX-License-Identifier: Apache-2.0
"""Where the page is served, as the parameters of a node say."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from rcl_interfaces.msg import ParameterDescriptor
from rviz_common.page.settings import PageSettings, PARAMETERS

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['page_settings', 'unknown_parameters']


def page_settings(node: Node) -> PageSettings:
    """Declare the parameters and return what they say, or raise ValueError."""
    values = {name: _declare(node, name, *about) for name, about in PARAMETERS.items()}
    return PageSettings(values['host'], values['port'] or None, values['token'])


def unknown_parameters(node: Node) -> list[str]:
    """Return a sentence for each parameter that is given, but that nobody has declared."""
    from robot_state_publisher.unknown_parameters import unknown_parameters

    given = getattr(node, '_parameter_overrides', {})  # rclpy has no public way to ask for them
    return unknown_parameters(given, node.get_parameters_by_prefix('').keys())


def _declare(node: Node, name: str, default: str | int, text: str) -> Any:
    descriptor = ParameterDescriptor(description=text, read_only=True)
    return node.declare_parameter(name, default, descriptor).value
