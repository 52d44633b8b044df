# SPDX-License-Identifier: Apache-2.0
"""The quality of service of what is kept for those who come later."""

from rclpy.qos import DurabilityPolicy, QoSProfile

__all__ = ['LATCHED']

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""The newest message, for all who subscribe: maps, costmaps, what changes rarely."""
