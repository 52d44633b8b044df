# SPDX-License-Identifier: Apache-2.0
"""Declaration of the parameters of joint_state_publisher."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from joint_state_publisher.settings import DESCRIPTIONS, MAPS, Settings, settings_of
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from robot_state_publisher.node_arguments import unknown_parameters

__all__ = ['CHANGEABLE', 'Extra', 'declare_settings']

CHANGEABLE = ('robot_description', 'delta')


@dataclass(frozen=True)
class Extra:
    """An additional, read-only parameter of a derived node."""

    default: Any
    description: str


def declare_settings(node: Node, extras: Mapping[str, Extra]) -> Settings:
    """
    Declare the parameters of the node, including those given for individual joints.

    rclpy has no public API for parameter overrides; parameters that it declares automatically have
    no description, and it does not accept an empty list.

    Parameters
    ----------
    node
        The node; it logs a warning for each unknown parameter.
    extras
        Additional parameters of a derived node, by name.

    Returns
    -------
    Settings
        The initial values, without those of `extras`.

    Raises
    ------
    ValueError
        A value is invalid.

    """
    descriptions = {
        **DESCRIPTIONS,
        **{name: extra.description for name, extra in extras.items()},
    }
    given = {name: each.value for name, each in getattr(node, '_parameter_overrides', {}).items()}
    for sentence in unknown_parameters(given, descriptions, MAPS):
        node.get_logger().warning(sentence)
    settings = settings_of(given)
    defaults = {**vars(settings), **{name: extra.default for name, extra in extras.items()}}
    of_joints = [name for name in given if name.startswith(MAPS)]
    for name in (*descriptions, *of_joints):
        default = defaults.get(name, given.get(name))
        descriptor = ParameterDescriptor(
            description=descriptions.get(name, ''),
            read_only=name not in CHANGEABLE,
            dynamic_typing=True,
        )
        value = list(default) if isinstance(default, tuple) else default
        node.declare_parameter(name, value, descriptor)
    return settings
