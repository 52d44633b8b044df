# SPDX-License-Identifier: Apache-2.0
"""Validation of topic names from users, files and browsers."""

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
    Resolve the full name of a topic, with the namespace and remappings of a node.

    Parameters
    ----------
    node
        The node whose namespace and remappings apply.
    name
        The name, as given by a user, a file or a browser.

    Raises
    ------
    ValueError
        The text is not a valid topic name. The exceptions of rclpy for these depend on the fault,
        and their messages have several lines, or the line of a C file.

    """
    try:
        full: str = node.resolve_topic_name(name)
    except Exception as error:  # rclpy has no single exception for invalid names
        shown = name if len(name) <= LONGEST_SHOWN else f'{name[:LONGEST_SHOWN]}...'
        found = REASON.match(str(error))
        reason = found['reason'] if found else error
        raise ValueError(f"'{shown}' is no name of a topic: {reason}.") from error
    return full


def is_full_topic_name(name: str) -> bool:
    """
    Whether ROS nodes can subscribe to a name: the graph also lists topics of other DDS programs.

    Parameters
    ----------
    name
        The name of the topic, as in the graph.

    """
    return FULL_NAME.fullmatch(name) is not None
