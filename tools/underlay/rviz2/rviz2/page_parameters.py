# SPDX-License-Identifier: Apache-2.0
"""The settings of the page, from the parameters of a node."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from rcl_interfaces.msg import ParameterDescriptor
from rviz_common.page.settings import PageSettings, PARAMETERS

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['page_settings', 'unknown_parameters']


def page_settings(node: Node) -> PageSettings:
    """
    Declare the parameters `host`, `port` and `token`, and read the settings of the page from them.

    Parameters
    ----------
    node
        The node that declares them, read-only. A `port` of 0 stands for the first free one.

    Raises
    ------
    ValueError
        The host is not an IP address, the port is outside 1 to 65535, or the token is `none` on an
        address that other machines reach.
    rclpy.exceptions.ParameterException
        A parameter has been overridden with a value of another type.

    """
    values = {name: _declare(node, name, *about) for name, about in PARAMETERS.items()}
    return PageSettings(values['host'], values['port'] or None, values['token'])


def unknown_parameters(node: Node) -> list[str]:
    """
    Format a warning for each parameter override that the node has not declared.

    Parameters
    ----------
    node
        The node, once it has declared all its parameters.

    """
    from robot_state_publisher.unknown_parameters import unknown_parameters

    given = getattr(node, '_parameter_overrides', {})  # rclpy has no public API for them
    return unknown_parameters(given, node.get_parameters_by_prefix('').keys())


def _declare(node: Node, name: str, default: str | int, text: str) -> Any:
    descriptor = ParameterDescriptor(description=text, read_only=True)
    return node.declare_parameter(name, default, descriptor).value
