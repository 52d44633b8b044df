# SPDX-License-Identifier: Apache-2.0
"""The parameters of joint_state_publisher, as a node has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from joint_state_publisher.settings import DESCRIPTIONS, MAPS, Settings, settings_of
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from robot_state_publisher.unknown_parameters import unknown_parameters

__all__ = ['CHANGEABLE', 'Extra', 'declare_settings']

CHANGEABLE = ('robot_description', 'delta')


@dataclass(frozen=True)
class Extra:
    """A parameter of a node that does more; it cannot be changed."""

    default: Any
    description: str


def declare_settings(node: Node, extras: Mapping[str, Extra]) -> Settings:
    """
    Declare what was not given, describe all, and return the first values.

    The node has declared what was given, as it cannot know the joints that `zeros` names.
    """
    descriptions = {
        **DESCRIPTIONS,
        **{name: extra.description for name, extra in extras.items()},
    }
    given = {name: each.value for name, each in node.get_parameters_by_prefix('').items()}
    for sentence in unknown_parameters(given, descriptions, MAPS):
        node.get_logger().warning(sentence)
    settings = settings_of(given)
    for name, text in descriptions.items():
        if name not in given:
            default = extras[name].default if name in extras else getattr(settings, name)
            value = list(default) if isinstance(default, tuple) else default
            node.declare_parameter(name, value, ParameterDescriptor(dynamic_typing=True))
        node.set_descriptor(
            name,
            ParameterDescriptor(
                description=text, read_only=name not in CHANGEABLE, dynamic_typing=True
            ),
        )
    return settings
