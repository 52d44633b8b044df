# SPDX-License-Identifier: Apache-2.0
"""The properties of a topic that is shown: its name and QoS profile."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from rviz_common.properties.property import Choice, Property, Topic, Whole

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile
    from rviz_common.properties.values import Values

__all__ = ['qos_of', 'topic_path', 'topic_properties']

BEST_EFFORT, RELIABLE, SYSTEM_DEFAULT = 'Best Effort', 'Reliable', 'System Default'
TRANSIENT_LOCAL, VOLATILE = 'Transient Local', 'Volatile'
KEEP_ALL, KEEP_LAST = 'Keep All', 'Keep Last'


def topic_properties(
    type_name: str,
    topic: str = '',
    *,
    path: str = 'Topic',
    depth: int = 5,
    durability: str = VOLATILE,
) -> tuple[Property, ...]:
    """
    Define the properties of a topic: its name and QoS profile.

    Parameters
    ----------
    type_name
        The type of its messages, such as `nav_msgs/msg/Path`.
    topic
        The default topic.
    path
        The path in the file below which the properties are.
    depth
        The default queue depth, in messages.
    durability
        The default durability, as named in files: `Volatile` or `Transient Local`.

    """
    return (
        Topic(f'{path}/Value', topic, 'The topic of the messages.', type_name),
        Whole(f'{path}/Depth', depth, 'Size of the message queue.', 1, 100000),
        Choice(
            f'{path}/Durability Policy',
            durability,
            'Transient Local also receives messages published earlier.',
            (VOLATILE, TRANSIENT_LOCAL, SYSTEM_DEFAULT),
        ),
        Choice(
            f'{path}/History Policy',
            KEEP_LAST,
            'Whether to drop messages beyond the depth.',
            (KEEP_LAST, KEEP_ALL, SYSTEM_DEFAULT),
        ),
        Choice(
            f'{path}/Reliability Policy',
            RELIABLE,
            'Best Effort also receives from best-effort publishers.',
            (RELIABLE, BEST_EFFORT, SYSTEM_DEFAULT),
        ),
    )


def topic_path(properties: Iterable[Property]) -> str:
    """
    Find the path of the first property that is the name of a topic.

    Parameters
    ----------
    properties
        The properties to look through.

    Returns
    -------
    str
        Such as `Topic/Value`; '' if there is none.

    """
    return next((each.path for each in properties if isinstance(each, Topic)), '')


def qos_of(values: Values, path: str = 'Topic') -> QoSProfile:
    """
    Make the QoS profile from the properties of a topic.

    Parameters
    ----------
    values
        The values of the properties.
    path
        The path of those of the topic, as for `topic_properties`.

    """
    from rclpy import qos

    reliability = {
        RELIABLE: qos.ReliabilityPolicy.RELIABLE,
        BEST_EFFORT: qos.ReliabilityPolicy.BEST_EFFORT,
        SYSTEM_DEFAULT: qos.ReliabilityPolicy.SYSTEM_DEFAULT,
    }
    durability = {
        VOLATILE: qos.DurabilityPolicy.VOLATILE,
        TRANSIENT_LOCAL: qos.DurabilityPolicy.TRANSIENT_LOCAL,
        SYSTEM_DEFAULT: qos.DurabilityPolicy.SYSTEM_DEFAULT,
    }
    history = {
        KEEP_LAST: qos.HistoryPolicy.KEEP_LAST,
        KEEP_ALL: qos.HistoryPolicy.KEEP_ALL,
        SYSTEM_DEFAULT: qos.HistoryPolicy.SYSTEM_DEFAULT,
    }
    return qos.QoSProfile(
        depth=values[f'{path}/Depth'],
        reliability=reliability[values[f'{path}/Reliability Policy']],
        durability=durability[values[f'{path}/Durability Policy']],
        history=history[values[f'{path}/History Policy']],
    )
