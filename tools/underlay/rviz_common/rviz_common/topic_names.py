# SPDX-License-Identifier: Apache-2.0
"""Names of topics that people, files and browsers give."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['full_topic_name', 'is_full_topic_name']

FULL_NAME = re.compile(r'(/[A-Za-z_][A-Za-z0-9_]*)+')
REASON = re.compile(r'^(?:failed to resolve name: )?(?P<reason>.*?)(?:, at /.*)?$', re.S)
LONGEST_SHOWN = 60


def full_topic_name(node: Node, name: str) -> str:
    """
    Resolve the full name of a topic, with namespaces and remappings of a node.

    Parameters
    ----------
    node
        The node whose namespace and remappings apply.
    name
        The name as a user, a file or a browser gives it.

    Raises
    ------
    ValueError
        The text is no name of a topic. What rclpy raises for those depends on what is wrong, and
        has the line of a C file or several lines.

    """
    try:
        full: str = node.resolve_topic_name(name)
    except Exception as error:  # rclpy has no one exception for bad names
        shown = name if len(name) <= LONGEST_SHOWN else f'{name[:LONGEST_SHOWN]}...'
        found = REASON.match(str(error))
        reason = found['reason'] if found else error
        raise ValueError(f"'{shown}' is no name of a topic: {reason}.") from error
    return full


def is_full_topic_name(name: str) -> bool:
    """
    Whether ROS nodes can subscribe a name: the graph also lists topics of other DDS programs.

    Parameters
    ----------
    name
        The name of the topic, as the graph has it.

    """
    return FULL_NAME.fullmatch(name) is not None
