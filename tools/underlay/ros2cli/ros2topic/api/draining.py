# SPDX-License-Identifier: Apache-2.0
"""Take the messages that have piled up, without a round through the executor for each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

MOST_AT_ONCE = 500


def drain(subscription: Any) -> Iterator[tuple[Any, Any]]:
    """Yield the waiting messages with their info; not all of an endless stream."""
    handle = subscription.handle
    with handle:
        for _ in range(MOST_AT_ONCE):
            taken = handle.take_message(subscription.msg_type, subscription.raw)
            if taken is None:
                return
            yield taken
