# SPDX-License-Identifier: Apache-2.0
"""Parameters of both programs: the quality of service, and what the command line may say."""

from __future__ import annotations

from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Mapping
from typing import Any, TypeVar

from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy
from robot_state_publisher.node_arguments import unknown_overrides
from rviz_common.page.address import PARAMETERS as OF_THE_PAGE

__all__ = ['QOS', 'checked', 'declare', 'declare_qos', 'parse_options']

QOS: Mapping[str, tuple[Any, str]] = {
    'reliability': ('reliable', 'Quality of service: reliable or best_effort.'),
    'history': ('keep_last', 'Quality of service: keep_last or keep_all.'),
    'depth': (10, 'How many images are kept with keep_last.'),
}
"""The parameters of the quality of service, by name: the default, and a description."""
RELIABILITIES = {
    'reliable': ReliabilityPolicy.RELIABLE,
    'best_effort': ReliabilityPolicy.BEST_EFFORT,
}
HISTORIES = {'keep_last': HistoryPolicy.KEEP_LAST, 'keep_all': HistoryPolicy.KEEP_ALL}

NodeT = TypeVar('NodeT', bound=Node)


def declare(node: Node, name: str, default: Any, text: str) -> Any:
    """
    Declare a parameter that only counts at the start; return its value.

    Parameters
    ----------
    node
        The node.
    name, default, text
        The name of the parameter, its default, and what it means.

    """
    descriptor = ParameterDescriptor(description=text, read_only=True)
    return node.declare_parameter(name, default, descriptor).value


def declare_qos(node: Node) -> QoSProfile:
    """
    Declare the parameters of `QOS`, and return the quality of service that they say.

    Parameters
    ----------
    node
        The node.

    Raises
    ------
    ValueError
        A value is not one of those that there are.

    """
    values = {name: declare(node, name, *rest) for name, rest in QOS.items()}
    for name, known in (('reliability', RELIABILITIES), ('history', HISTORIES)):
        if values[name] not in known:
            raise ValueError(
                f"The parameter {name} is '{values[name]}': give {' or '.join(known)}."
            )
    if values['depth'] < 1:
        raise ValueError(f'The parameter depth is {values["depth"]}: give 1 or more.')
    return QoSProfile(
        depth=values['depth'],
        reliability=RELIABILITIES[values['reliability']],
        history=HISTORIES[values['history']],
    )


def parse_options(
    program: str, text: str, words: list[str], own: Mapping[str, tuple[Any, str]]
) -> None:
    """
    Check that there are no arguments; `-h` prints the parameters.

    Parameters
    ----------
    program
        The name of the executable.
    text
        What it does.
    words
        The arguments, without those of ROS.
    own
        The parameters of the program beside those of `QOS`: as there.

    """
    lines = [
        f'  {name:12} {description} (default: {default!r})'
        for name, (default, description) in {**own, **QOS, **OF_THE_PAGE}.items()
    ]
    epilog = 'Parameters, after --ros-args -p, as in -p depth:=5:\n' + '\n'.join(lines)
    ArgumentParser(
        prog=program,
        description=text,
        epilog=epilog,
        formatter_class=RawDescriptionHelpFormatter,
    ).parse_args(words)


def checked(node: NodeT) -> NodeT:
    """
    Warn of parameters that a node does not have; return the node.

    Parameters
    ----------
    node
        The node.

    """
    for sentence in unknown_overrides(node):
        node.get_logger().warning(sentence)
    return node
