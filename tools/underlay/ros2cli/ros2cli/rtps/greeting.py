# SPDX-License-Identifier: Apache-2.0
"""
Our own announcement: a participant without nodes, with a reader of `ros_discovery_info`.

We appear in no list: `ros2` commands and rclpy ignore participants that announce no enclave.
"""

from __future__ import annotations

from collections.abc import Sequence
import os

from ros2cli.rtps.entities import RELIABLE, TOPIC, TRANSIENT_LOCAL, TYPE_NAME
from ros2cli.rtps.identifiers import (
    BUILTIN_ENDPOINTS,
    ENTITIES_READER,
    PARTICIPANT,
    PARTICIPANTS_WRITER,
    PID_BUILTIN_ENDPOINTS,
    PID_DEFAULT_UNICAST_LOCATOR,
    PID_DURABILITY,
    PID_ENDPOINT_GUID,
    PID_KEY_HASH,
    PID_LEASE_DURATION,
    PID_METATRAFFIC_UNICAST_LOCATOR,
    PID_PARTICIPANT_GUID,
    PID_PROTOCOL_VERSION,
    PID_RELIABILITY,
    PID_STATUS_INFO,
    PID_TOPIC_NAME,
    PID_TYPE_NAME,
    PID_VENDOR_ID,
    PREFIX_BYTES,
    PROTOCOL_VERSION,
    SUBSCRIPTIONS_READER,
    SUBSCRIPTIONS_WRITER,
    UNKNOWN_ENTITY,
    VENDOR_UNKNOWN,
)
from ros2cli.rtps.message import data, heartbeat, message
from ros2cli.rtps.parameters import (
    Address,
    duration_value,
    encode_inline,
    encode_parameters,
    locator_value,
    number_value,
    text_value,
)

LEASE_S = 10
DISPOSED = b'\0\0\0\3'


def new_prefix() -> bytes:
    """Return a new unique GUID prefix for us."""
    return VENDOR_UNKNOWN + os.urandom(PREFIX_BYTES - len(VENDOR_UNKNOWN))


def greeting(prefix: bytes, addresses: Sequence[Address]) -> bytes:
    """
    Build the datagram that makes a participant describe itself to us.

    Parameters
    ----------
    prefix
        Our GUID prefix (12 bytes).
    addresses
        The addresses at which others reach our socket.

    """
    return message(
        prefix,
        data(UNKNOWN_ENTITY, PARTICIPANTS_WRITER, 1, _participant(prefix, addresses)),
        data(SUBSCRIPTIONS_READER, SUBSCRIPTIONS_WRITER, 1, _reader(prefix)),
        heartbeat(SUBSCRIPTIONS_READER, SUBSCRIPTIONS_WRITER, 1, 1, 1),
    )


def farewell(prefix: bytes) -> bytes:
    """
    Build the datagram that makes a participant forget us.

    Parameters
    ----------
    prefix
        Our GUID prefix (12 bytes).

    """
    guid = prefix + PARTICIPANT
    qos = encode_inline([(PID_KEY_HASH, guid), (PID_STATUS_INFO, DISPOSED)])
    key = encode_parameters([(PID_PARTICIPANT_GUID, guid)])
    return message(prefix, data(UNKNOWN_ENTITY, PARTICIPANTS_WRITER, 2, key, qos))


def _participant(prefix: bytes, addresses: Sequence[Address]) -> bytes:
    locators = [locator_value(address) for address in addresses]
    return encode_parameters(
        [
            (PID_PROTOCOL_VERSION, PROTOCOL_VERSION),
            (PID_VENDOR_ID, VENDOR_UNKNOWN),
            (PID_PARTICIPANT_GUID, prefix + PARTICIPANT),
            *((PID_METATRAFFIC_UNICAST_LOCATOR, locator) for locator in locators),
            *((PID_DEFAULT_UNICAST_LOCATOR, locator) for locator in locators),
            (PID_LEASE_DURATION, duration_value(LEASE_S)),
            (PID_BUILTIN_ENDPOINTS, number_value(BUILTIN_ENDPOINTS)),
        ]
    )


def _reader(prefix: bytes) -> bytes:
    guid = prefix + ENTITIES_READER
    return encode_parameters(
        [
            (PID_PARTICIPANT_GUID, prefix + PARTICIPANT),
            (PID_ENDPOINT_GUID, guid),
            (PID_KEY_HASH, guid),
            (PID_TOPIC_NAME, text_value(TOPIC)),
            (PID_TYPE_NAME, text_value(TYPE_NAME)),
            (PID_RELIABILITY, number_value(RELIABLE) + duration_value(0)),
            (PID_DURABILITY, number_value(TRANSIENT_LOCAL)),
        ]
    )
