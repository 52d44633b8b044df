# SPDX-License-Identifier: Apache-2.0
"""Distinguish live messages from those that are repeated for a late subscription."""

from __future__ import annotations

from collections.abc import Mapping

USUAL_DELAY_NS = 50_000_000
CONNECTION_NS = 2_000_000_000


class Backlog:
    """
    Filter for messages that were published before the subscription was connected.

    A reliable publisher discovers us some time before we discover it, and repeats the messages
    published in between in one burst, which is not representative of its rate.
    """

    def __init__(self) -> None:
        """Start before the first message."""
        self._start_ns: int | None = None

    def has(self, info: Mapping[str, int]) -> bool:
        """
        Check whether a message was published before the subscription was connected.

        Call once for each message, in the order of arrival.

        Parameters
        ----------
        info
            The message info of rclpy, with `source_timestamp` and `received_timestamp` in ns.

        Returns
        -------
        bool
            Whether the message was delivered late, as part of the backlog.

        """
        received_ns, source_ns = info['received_timestamp'], info['source_timestamp']
        if self._start_ns is None:
            self._start_ns = received_ns
            return received_ns - source_ns > USUAL_DELAY_NS
        return source_ns < self._start_ns and received_ns < self._start_ns + CONNECTION_NS
