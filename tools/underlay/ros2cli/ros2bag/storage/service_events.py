# SPDX-License-Identifier: Apache-2.0
"""
Which recorded topics are the events of a service, and how many calls they tell of.

A service whose introspection is on publishes its requests and responses on a hidden topic.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
import re
from typing import NamedTuple

__all__ = ['EVENT_SUFFIX', 'CallCounts', 'Service', 'count_calls', 'event_topic', 'service_of']

EVENT_SUFFIX = '/_service_event'
_TYPE = re.compile(r'(?P<service>[^/]+/srv/[^/]+)_Event')
# The first field of service_msgs/msg/ServiceEventInfo, behind the 4 bytes that begin a message.
_KIND = 4
# In the order of the kinds: a request sent and received, a response sent and received.
_KINDS = range(4)


class Service(NamedTuple):
    """A service by its name and type."""

    name: str
    type_name: str


class CallCounts(NamedTuple):
    """How many requests and responses were recorded, by whichever side."""

    requests: int
    responses: int


def service_of(topic: str, type_name: str) -> Service | None:
    """
    Return the service whose events a topic has; None for any other topic.

    Parameters
    ----------
    topic
        The full name of the topic.
    type_name
        Its type, such as `example_interfaces/srv/AddTwoInts_Event`.

    """
    match = _TYPE.fullmatch(type_name)
    if match is None or not topic.endswith(EVENT_SUFFIX):
        return None
    return Service(topic.removesuffix(EVENT_SUFFIX), match['service'])


def event_topic(service: str) -> str:
    """
    Return the name of the topic with the events of a service.

    Parameters
    ----------
    service
        The full name of the service.

    """
    return f'{service}{EVENT_SUFFIX}'


def count_calls(events: Iterable[bytes]) -> CallCounts:
    """
    Count requests and responses, as told by clients or by servers, whoever tells of more.

    Parameters
    ----------
    events
        The serialized events of a service.

    """
    found = Counter(event[_KIND] for event in events if len(event) > _KIND)
    sent, received, answered, heard = (found[kind] for kind in _KINDS)
    return CallCounts(max(sent, received), max(answered, heard))
