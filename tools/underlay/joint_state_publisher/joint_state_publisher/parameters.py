# SPDX-License-Identifier: Apache-2.0
"""The parameters of joint_state_publisher, as a node has them."""

from __future__ import annotations

from joint_state_publisher.settings import DESCRIPTIONS, MAPS, Settings, settings_of
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from robot_state_publisher.unknown_parameters import unknown_parameters

__all__ = ['CHANGEABLE', 'declare_settings']

CHANGEABLE = ('robot_description', 'delta')


def declare_settings(node: Node) -> Settings:
    """
    Declare the parameters, those of the joints as they were given, and return the first values.

    rclpy has no public way to ask what was given; what it declares by itself it cannot describe,
    and it does not take an empty list.
    """
    given = {name: each.value for name, each in getattr(node, '_parameter_overrides', {}).items()}
    for sentence in unknown_parameters(given, DESCRIPTIONS, MAPS):
        node.get_logger().warning(sentence)
    settings = settings_of(given)
    of_joints = [name for name in given if name.startswith(MAPS)]
    for name in (*DESCRIPTIONS, *of_joints):
        default = getattr(settings, name, given.get(name))
        descriptor = ParameterDescriptor(
            description=DESCRIPTIONS.get(name, ''),
            read_only=name not in CHANGEABLE,
            dynamic_typing=True,
        )
        value = list(default) if isinstance(default, tuple) else default
        node.declare_parameter(name, value, descriptor)
    return settings
