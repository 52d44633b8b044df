# SPDX-License-Identifier: Apache-2.0
"""
Deserialize a `nav2_msgs/msg/ParticleCloud`.

rclpy would create four Python objects for each of thousands of particles; the serialized message
has them as rows of eight doubles, which numpy reads at once.
"""

from __future__ import annotations

import struct
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ['ParticleMessage', 'read_particles']

HEADER = 4
"""The size in bytes of the CDR encapsulation before the data, from which alignment counts."""
ROW = 8
"""Row layout: position, orientation x, y, z, w, and the weight."""

Floats = NDArray[np.float64]


class ParticleMessage(NamedTuple):
    """
    Particle cloud.

    `poses` has a row for each: x, y, z in metres, and the quaternion x, y, z, w.
    """

    header: Any
    poses: Floats
    weights: Floats


def read_particles(data: bytes) -> ParticleMessage:
    """
    Deserialize a message.

    Parameters
    ----------
    data
        The message in CDR, as from a raw subscription.

    Returns
    -------
    ParticleMessage
        The header (stamp and frame_id), poses (N, 7) and weights (N,).

    Raises
    ------
    ValueError
        The bytes are not such a message.

    """
    order = '<' if len(data) > 1 and data[1] & 1 else '>'
    try:
        sec, nanosec, length = struct.unpack_from(f'{order}iII', data, HEADER)
        begin = HEADER + 12
        frame_id = data[slice(begin, begin + length - 1)].decode()
        at = _aligned(begin + length, 4)
        (count,) = struct.unpack_from(f'{order}I', data, at)
        at = _aligned(at + 4, 8) if count else at
        rows = np.frombuffer(data, f'{order}f8', count * ROW, at).reshape(count, ROW)
    except (struct.error, ValueError) as error:
        raise ValueError(f'its {len(data)} bytes are not a ParticleCloud: {error}.') from error
    stamp = SimpleNamespace(sec=sec, nanosec=nanosec)
    header = SimpleNamespace(stamp=stamp, frame_id=frame_id)
    return ParticleMessage(header, rows[:, :7].astype(float), rows[:, 7].astype(float))


def _aligned(offset: int, size: int) -> int:
    """Align an offset to a multiple of a size, counted after the encapsulation."""
    return HEADER + -(-(offset - HEADER) // size) * size
