# SPDX-License-Identifier: Apache-2.0
"""The time by which a message is sorted and matched."""

from __future__ import annotations

from typing import Any

from rclpy.clock import ROSClock
from rclpy.logging import get_logger
from rclpy.time import Time

__all__ = ['nanoseconds', 'stamp_ns']


def nanoseconds(stamp: Any) -> int:
    """
    Convert a time to nanoseconds.

    Parameters
    ----------
    stamp
        An `rclpy.time.Time`, or the stamp of a message.

    """
    if isinstance(stamp, Time):
        return int(stamp.nanoseconds)
    return int(Time.from_msg(stamp).nanoseconds)


def stamp_ns(msg: Any, source: Any, *, allow_headerless: bool) -> int | None:
    """
    Return the time of a message in nanoseconds.

    Parameters
    ----------
    msg
        The message.
    source
        The filter that it comes from; the clock of its node tells the time of arrival.
    allow_headerless
        Whether a message without a header gets the time of its arrival.

    Returns
    -------
    int or None
        None, and a warning, for a message without a header that may not be without.

    """
    stamp = getattr(getattr(msg, 'header', None), 'stamp', None)
    if stamp is not None:
        return nanoseconds(stamp)
    if not allow_headerless:
        get_logger('message_filters').warning(
            f'A message of type {type(msg).__name__} has no header with a time stamp, so it is '
            'left out. allow_headerless=True gives such messages the time of their arrival.',
            throttle_duration_sec=10.0,
        )
        return None
    node = getattr(source, 'node', None)
    clock = node.get_clock() if node is not None else ROSClock()
    return int(clock.now().nanoseconds)
