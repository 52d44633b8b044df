# SPDX-License-Identifier: Apache-2.0
"""Take pending messages without an executor cycle for each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

MOST_AT_ONCE = 500


def drain(subscription: Any) -> Iterator[tuple[Any, Any]]:
    """
    Yield the pending messages of a subscription, at most 500.

    Parameters
    ----------
    subscription
        The subscription of rclpy.

    Yields
    ------
    tuple
        The message, as bytes if the subscription is raw, and its message info.

    """
    handle = subscription.handle
    with handle:
        for _ in range(MOST_AT_ONCE):
            taken = handle.take_message(subscription.msg_type, subscription.raw)
            if taken is None:
                return
            yield taken
