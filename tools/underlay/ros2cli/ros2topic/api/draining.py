# SPDX-License-Identifier: Apache-2.0
"""Take the messages that have piled up, without a round through the executor for each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

MOST_AT_ONCE = 500


def drain(subscription: Any) -> Iterator[tuple[Any, Any]]:
    """
    Take the messages that are waiting in a subscription, at most 500 of them.

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
