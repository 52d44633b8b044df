# SPDX-License-Identifier: Apache-2.0
"""Protocol constants: entity IDs, parameter IDs, limits and ports (9.3.1.2, 9.6.2.3, 9.6.3)."""

from __future__ import annotations

PROTOCOL_VERSION = b'\x02\x03'
VENDOR_UNKNOWN = b'\x00\x00'
VENDOR_EPROSIMA = b'\x01\x0f'
PREFIX_BYTES = 12
VENDOR_BYTES = 2  # with which a GUID prefix begins
MAX_NUMBERS = 256  # in a set of sequence numbers

UNKNOWN_ENTITY = bytes.fromhex('00000000')
PARTICIPANT = bytes.fromhex('000001c1')
PARTICIPANTS_WRITER = bytes.fromhex('000100c2')
PARTICIPANTS_READER = bytes.fromhex('000100c7')
PUBLICATIONS_WRITER = bytes.fromhex('000003c2')
PUBLICATIONS_READER = bytes.fromhex('000003c7')
SUBSCRIPTIONS_WRITER = bytes.fromhex('000004c2')
SUBSCRIPTIONS_READER = bytes.fromhex('000004c7')
ENTITIES_READER = bytes.fromhex('00000104')  # our own: a reader of a keyless topic

PID_LEASE_DURATION = 0x02
PID_TOPIC_NAME = 0x05
PID_TYPE_NAME = 0x07
PID_PROTOCOL_VERSION = 0x15
PID_VENDOR_ID = 0x16
PID_RELIABILITY = 0x1A
PID_LIVELINESS = 0x1B
PID_DURABILITY = 0x1D
PID_DEADLINE = 0x23
PID_LIFESPAN = 0x2B
PID_USER_DATA = 0x2C
PID_DEFAULT_UNICAST_LOCATOR = 0x31
PID_METATRAFFIC_UNICAST_LOCATOR = 0x32
PID_PARTICIPANT_GUID = 0x50
PID_BUILTIN_ENDPOINTS = 0x58
PID_PROPERTY_LIST = 0x59
PID_ENDPOINT_GUID = 0x5A
PID_KEY_HASH = 0x70
PID_STATUS_INFO = 0x71
PID_SAMPLE_IDENTITY = 0x800F  # of Fast DDS: the related sample identity

# Our announced built-in endpoints (9.3.2): all of PDP and EDP except the publications writer,
# since we have no publications.
BUILTIN_ENDPOINTS = 0b111011

MULTICAST_ADDRESS = '239.255.0.1'
PORT_BASE = 7400
PORTS_PER_DOMAIN = 250
FIRST_UNICAST_PORT = 10
MAX_PARTICIPANTS = 120


def multicast_port(domain_id: int) -> int:
    """
    Return the multicast discovery port of a domain.

    Parameters
    ----------
    domain_id
        The ROS domain ID.

    """
    return PORT_BASE + PORTS_PER_DOMAIN * domain_id


def unicast_ports(domain_id: int) -> range:
    """
    Return the unicast discovery ports of a domain, by participant index.

    Parameters
    ----------
    domain_id
        The ROS domain ID.

    """
    first = multicast_port(domain_id) + FIRST_UNICAST_PORT
    return range(first, first + 2 * MAX_PARTICIPANTS, 2)
