# SPDX-License-Identifier: Apache-2.0
"""Readers and writers, as described by their participants (8.5.4.4, 9.6.2.2)."""

from __future__ import annotations

from typing import NamedTuple

from ros2cli.rtps.identifiers import (
    PID_DEADLINE,
    PID_DURABILITY,
    PID_ENDPOINT_GUID,
    PID_KEY_HASH,
    PID_LIFESPAN,
    PID_LIVELINESS,
    PID_RELIABILITY,
    PID_TOPIC_NAME,
    PID_TYPE_NAME,
    PID_USER_DATA,
)
from ros2cli.rtps.parameters import Parameters

BEST_EFFORT, RELIABLE = 1, 2
VOLATILE, TRANSIENT_LOCAL = 0, 1
AUTOMATIC, MANUAL_BY_TOPIC = 0, 2
GUID_BYTES = 16


class Qos(NamedTuple):
    """Quality of service as DDS enumerators; durations in nanoseconds."""

    reliability: int
    durability: int
    liveliness: int
    lease_ns: int
    deadline_ns: int
    lifespan_ns: int


class Endpoint(NamedTuple):
    """
    A reader or writer.

    :param guid: 16 bytes
    :param topic: name in DDS, with the prefix added by ROS
    :param type_name: name in DDS
    :param type_hash: REP-2016 string such as `RIHS01_...`, or ''
    """

    guid: bytes
    is_writer: bool
    topic: str
    type_name: str
    type_hash: str
    qos: Qos


def guid_of(parameters: Parameters) -> bytes:
    """
    Return the GUID (16 bytes) of an endpoint.

    Parameters
    ----------
    parameters : Parameters
        The description of the endpoint, or only its key.

    Raises
    ------
    ValueError
        There is no GUID, or it is damaged.

    """
    raw = parameters.first(PID_ENDPOINT_GUID) or parameters.first(PID_KEY_HASH)
    if len(raw) != GUID_BYTES:
        raise ValueError('an endpoint without identity')
    return raw


def endpoint_of(parameters: Parameters, *, is_writer: bool) -> Endpoint:
    """
    Decode an endpoint; missing parameters have the DDS defaults.

    Parameters
    ----------
    parameters : Parameters
        The description of the endpoint.
    is_writer
        Whether it is a writer, whose default reliability differs from that of a reader.

    Raises
    ------
    ValueError
        The description is damaged.

    """
    reliability = RELIABLE if is_writer else BEST_EFFORT
    return Endpoint(
        guid_of(parameters),
        is_writer,
        parameters.text(PID_TOPIC_NAME),
        parameters.text(PID_TYPE_NAME),
        _type_hash(parameters.octets(PID_USER_DATA)),
        Qos(
            parameters.number(PID_RELIABILITY, reliability),
            parameters.number(PID_DURABILITY, VOLATILE),
            parameters.number(PID_LIVELINESS, AUTOMATIC),
            parameters.duration_ns(PID_LIVELINESS, offset=4),
            parameters.duration_ns(PID_DEADLINE),
            parameters.duration_ns(PID_LIFESPAN),
        ),
    )


def _type_hash(user_data: bytes) -> str:
    for pair in user_data.decode('ascii', 'replace').split(';'):
        key, _, value = pair.partition('=')
        if key == 'typehash':
            return value
    return ''
