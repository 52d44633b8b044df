# SPDX-License-Identifier: Apache-2.0
"""QoS profiles by name, so that both ends of a topic use the same."""

from __future__ import annotations

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

__all__ = ['COMMAND', 'EVENT', 'LATCHED', 'SENSOR', 'STATE']


def _keep_last(
    depth: int,
    reliability: ReliabilityPolicy,
    durability: DurabilityPolicy = DurabilityPolicy.VOLATILE,
) -> QoSProfile:
    """Build a profile that keeps the newest messages."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=depth,
        reliability=reliability,
        durability=durability,
    )


SENSOR = _keep_last(5, ReliabilityPolicy.BEST_EFFORT)
"""Measurements: a newer one replaces a lost one, so no one waits for a retransmission."""

STATE = _keep_last(10, ReliabilityPolicy.RELIABLE)
"""Current state: every subscriber receives each message, with room for a short pause."""

COMMAND = _keep_last(1, ReliabilityPolicy.RELIABLE)
"""Commands: they must arrive, and only the newest one may be obeyed."""

LATCHED = _keep_last(1, ReliabilityPolicy.RELIABLE, DurabilityPolicy.TRANSIENT_LOCAL)
"""Rarely changing data, such as a robot description: late-joining subscribers receive it too."""

EVENT = _keep_last(50, ReliabilityPolicy.RELIABLE)
"""Events: each one counts, so a burst must fit into the queue."""
