# SPDX-License-Identifier: Apache-2.0
"""
Translate the DDS names of topics, services and types to ROS.

After the design article "Topic and Service name mapping to DDS" (design.ros2.org).
"""

from __future__ import annotations

import re
from typing import NamedTuple

TOPIC, REQUEST, RESPONSE = 'rt', 'rq', 'rr'
SUFFIXES = {TOPIC: '', REQUEST: 'Request', RESPONSE: 'Reply'}
TYPE = re.compile(r'(?P<namespace>.+)::dds_::(?P<name>.+)_')
PART_OF_SERVICE = re.compile(r'_(Request|Response)$')


class RosName(NamedTuple):
    """
    The ROS name and kind of a DDS topic.

    :param kind: TOPIC, REQUEST or RESPONSE
    :param name: name of the topic or service
    """

    kind: str
    name: str


def ros_name(topic: str) -> RosName | None:
    """
    Translate the name of a DDS topic to ROS.

    Parameters
    ----------
    topic
        The name in DDS, such as `rt/chatter`.

    Returns
    -------
    RosName or None
        The name and kind in ROS; None if the topic does not come from ROS.

    """
    kind, slash, rest = topic.partition('/')
    suffix = SUFFIXES.get(kind)
    if suffix is None or not slash or not rest.endswith(suffix):
        return None
    return RosName(kind, f'/{rest.removesuffix(suffix)}')


def ros_type(type_name: str) -> str:
    """
    Translate the name of a DDS type to ROS, as `pkg/msg/Name`.

    Parameters
    ----------
    type_name
        The name in DDS; it is returned as it is if it does not come from ROS.

    """
    match = TYPE.fullmatch(type_name)
    if not match:
        return type_name
    return f'{match["namespace"].replace("::", "/")}/{match["name"]}'


def service_type(type_name: str) -> str:
    """
    Translate the DDS type of a service's requests or responses to ROS, as `pkg/srv/Name`.

    Parameters
    ----------
    type_name
        The name in DDS.

    """
    return PART_OF_SERVICE.sub('', ros_type(type_name))
