# SPDX-License-Identifier: Apache-2.0
"""How we announce ourselves to participants and discovery servers, and take leave of them."""

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
    PID_PROPERTY_LIST,
    PID_PROTOCOL_VERSION,
    PID_RELIABILITY,
    PID_SAMPLE_IDENTITY,
    PID_STATUS_INFO,
    PID_TOPIC_NAME,
    PID_TYPE_NAME,
    PID_VENDOR_ID,
    PREFIX_BYTES,
    PROTOCOL_VERSION,
    SUBSCRIPTIONS_READER,
    SUBSCRIPTIONS_WRITER,
    UNKNOWN_ENTITY,
    VENDOR_BYTES,
    VENDOR_EPROSIMA,
)
from ros2cli.rtps.message import data, heartbeat, message, sequence_number
from ros2cli.rtps.parameters import (
    Address,
    duration_value,
    encode_inline,
    encode_parameters,
    locator_value,
    number_value,
    properties_value,
    text_value,
)

LEASE_S = 10
DISPOSED = b'\0\0\0\3'
SUPER_CLIENT = {'PARTICIPANT_TYPE': 'SUPER_CLIENT', 'DS_VERSION': '2.0'}


def new_prefix(vendor: bytes) -> bytes:
    """
    Return a new unique GUID prefix for us.

    Parameters
    ----------
    vendor
        The vendor ID (2 bytes) that we announce.

    """
    return vendor + os.urandom(PREFIX_BYTES - VENDOR_BYTES)


def greeting(prefix: bytes, addresses: Sequence[Address]) -> bytes:
    """
    Build the datagram that makes a participant or a discovery server describe itself to us.

    Discovery servers listen only to Fast DDS: with its vendor ID we announce a super client, whom
    they tell about all of their clients.

    Parameters
    ----------
    prefix
        Our GUID prefix (12 bytes), which begins with the vendor ID.
    addresses
        The addresses at which others reach our socket.

    """
    return message(
        prefix,
        data(
            UNKNOWN_ENTITY,
            PARTICIPANTS_WRITER,
            1,
            _participant(prefix, addresses),
            _origin(prefix, PARTICIPANTS_WRITER, 1),
        ),
        data(
            SUBSCRIPTIONS_READER,
            SUBSCRIPTIONS_WRITER,
            1,
            _reader(prefix),
            _origin(prefix, SUBSCRIPTIONS_WRITER, 1),
        ),
        heartbeat(SUBSCRIPTIONS_READER, SUBSCRIPTIONS_WRITER, 1, 1, 1),
    )


def farewell(prefix: bytes) -> bytes:
    """
    Build the datagram that makes a participant or a discovery server forget us.

    Parameters
    ----------
    prefix
        Our GUID prefix (12 bytes).

    """
    guid = prefix + PARTICIPANT
    qos = [(PID_KEY_HASH, guid), (PID_STATUS_INFO, DISPOSED)]
    inline = encode_inline([*qos, *_identity(prefix, PARTICIPANTS_WRITER, 2)])
    key = encode_parameters([(PID_PARTICIPANT_GUID, guid)])
    return message(prefix, data(UNKNOWN_ENTITY, PARTICIPANTS_WRITER, 2, key, inline, is_key=True))


def _is_super_client(prefix: bytes) -> bool:
    return prefix.startswith(VENDOR_EPROSIMA)


def _identity(prefix: bytes, writer: bytes, number: int) -> list[tuple[int, bytes]]:
    """Return the parameters that tell a discovery server who has written a sample."""
    if not _is_super_client(prefix):
        return []
    return [(PID_SAMPLE_IDENTITY, prefix + writer + sequence_number(number))]


def _origin(prefix: bytes, writer: bytes, number: int) -> bytes:
    identity = _identity(prefix, writer, number)
    return encode_inline(identity) if identity else b''


def _participant(prefix: bytes, addresses: Sequence[Address]) -> bytes:
    locators = [locator_value(address) for address in addresses]
    properties = SUPER_CLIENT if _is_super_client(prefix) else {}
    return encode_parameters(
        [
            (PID_PROTOCOL_VERSION, PROTOCOL_VERSION),
            (PID_VENDOR_ID, prefix[:VENDOR_BYTES]),
            (PID_PARTICIPANT_GUID, prefix + PARTICIPANT),
            *((PID_METATRAFFIC_UNICAST_LOCATOR, locator) for locator in locators),
            *((PID_DEFAULT_UNICAST_LOCATOR, locator) for locator in locators),
            (PID_LEASE_DURATION, duration_value(LEASE_S)),
            (PID_BUILTIN_ENDPOINTS, number_value(BUILTIN_ENDPOINTS)),
            *((PID_PROPERTY_LIST, properties_value(each)) for each in [properties] if each),
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
