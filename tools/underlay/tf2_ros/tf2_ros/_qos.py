# SPDX-License-Identifier: Apache-2.0
"""The QoS of the topics of transforms."""

from rclpy.qos import DurabilityPolicy, QoSProfile

# A robot has many broadcasters, and none must be lost when a listener is late.
DYNAMIC = QoSProfile(depth=100)
# Late comers get what was said before they came, of each publisher.
STATIC_LISTENER = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
# Each message holds all static transforms of its publisher.
STATIC_BROADCASTER = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
