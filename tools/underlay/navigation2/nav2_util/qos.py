# SPDX-License-Identifier: Apache-2.0
"""Quality of service of latched topics, for late joiners."""

from rclpy.qos import DurabilityPolicy, QoSProfile

__all__ = ['LATCHED']

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""Transient local: the newest message for all subscribers, such as maps and costmaps."""
