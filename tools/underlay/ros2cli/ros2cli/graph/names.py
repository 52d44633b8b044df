# SPDX-License-Identifier: Apache-2.0
"""
The names that ROS gives to topics, services and types in DDS, and back.

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
    What a topic of DDS is to ROS.

    :param kind: TOPIC, REQUEST or RESPONSE
    :param name: of the topic or the service
    """

    kind: str
    name: str


def ros_name(topic: str) -> RosName | None:
    """Return what a topic of DDS is to ROS; None if it does not come from ROS."""
    kind, slash, rest = topic.partition('/')
    suffix = SUFFIXES.get(kind)
    if suffix is None or not slash or not rest.endswith(suffix):
        return None
    return RosName(kind, f'/{rest.removesuffix(suffix)}')


def ros_type(type_name: str) -> str:
    """Return `pkg/msg/Name` for a type of DDS; what does not come from ROS stays as it is."""
    match = TYPE.fullmatch(type_name)
    if not match:
        return type_name
    return f'{match["namespace"].replace("::", "/")}/{match["name"]}'


def service_type(type_name: str) -> str:
    """Return `pkg/srv/Name` for the type of a service's requests or responses."""
    return PART_OF_SERVICE.sub('', ros_type(type_name))
